#include "compare/study/figure_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "compare/base/format.h"
#include "compare/figures/figure.h"
#include "compare/model_error/model_error.h"
#include "compare/study/answer.h"

namespace rotorub {

// Written to JSON member by member.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Split, model_gap, step_error, native_step_error, uncertainty,
                                   valid, reason)

namespace {

using nlohmann::json;
using result::Item, result::Part, result::Row, result::Section, result::Sentence, result::Table;

// other: the key of the value that is compared with the native one.
json judged_json(const JudgedFigure& f, const char* other) {
  return {{"native", f.native},
          {other, f.other},
          {"difference", f.other - f.native},
          {"deviation", f.is_absent() ? json() : json(f.deviation)}};
}

json difference_json(const FigureDifference& f) {
  json all = judged_json(f, "other");
  all.update({{"twin_deviation", f.floor},
              {"interval", f.interval},
              {"least_told", f.least_detectable},
              {"replay_floor", f.replay_floor},
              {"judged", f.figure->is_judged()}});
  if (f.figure->is_judged()) {
    all["within"] = f.verdict == FigureVerdict::kWithin;
    all["verdict"] = to_string(f.verdict);
  }
  if (f.figure->split) all["split"] = f.split;
  return all;
}

// A table with a column of labels, of native, of its shadow if there is one, and of each MuJoCo
// side. The terminal leaves out some of these.
Table side_table(const SceneComparison& c, const std::string& label, const std::string& native,
                 const std::string& shadow) {
  constexpr int kValue = 9;  // with shadow and four contact models: 80 columns
  Table table{"", {{"", label, -26, result::kAll, "figure"}, {"", native, kValue}}};
  if (c.shadow.side) table.columns.push_back({"shadow", shadow, kValue});
  for (const ComparedModel& m : c.models) {
    const std::string name = m.kind().heading;
    table.columns.push_back({"differences/" + m.run.label, name, kValue,
                             name.empty() ? result::kNotTerminal : result::kAll, m.run.label});
  }
  return table;
}

// mujoco: the item, or its text, of each ComparedModel.
template <class Mujoco>
Row& add_row(Table& table, const SceneComparison& c, const char* lead, const std::string& label,
             const std::string& native, const Item& shadow, Mujoco mujoco) {
  Row& row = table.rows.emplace_back(Row{.items = {{label}, {native}}, .lead = lead});
  if (c.shadow.side) row.items.push_back(shadow);
  for (const ComparedModel& m : c.models) row.items.push_back({mujoco(m)});
  return row;
}

const char* lead_of(const Figure& f) { return f.is_judged() ? "* " : "  "; }

// The column omits every unit except "%"; the line below the differences says so.
std::string in_column(const std::string& text) {
  return text.ends_with(" %") ? text : text.substr(0, text.find(' '));
}
std::string in_column(const JudgedFigure& f) {
  return f.is_absent() ? "–" : in_column(deviation_text(f));
}

// The value of a figure, and on a page its difference from native.
Item value_item(const Figure& f, const Side& side, const JudgedFigure& d, bool by_step) {
  Item item{figure_value(f, f.value(side.metrics))};
  if (!f.is_judged() || d.is_absent()) return item;
  item.beside = difference_text(d);
  item.tone = by_step ? Tone::kPlain : tone_of(d.verdict);
  item.note = by_step ? "due to the step" : to_string(d.verdict);
  return item;
}

bool is_timed(const Side& side) { return !side.timing.us_per_step.empty(); }

Table value_table(const SceneComparison& c) {
  Table table = side_table(c, "", "native", "shadow");
  table.columns.push_back({.heading = "what it means", .seen = result::kPage});
  for (std::size_t k = 0; k < figures().size(); ++k) {
    const Figure& f = figures()[k];
    if (!is_shown(c, f)) continue;
    Item shadow;
    if (c.shadow.side) shadow = value_item(f, *c.shadow.side, c.shadow.figures[k], true);
    add_row(table, c, lead_of(f), figure_label(f), figure_value(f, f.value(c.native.metrics)),
            shadow,
            [&](const ComparedModel& m) { return value_item(f, m.run, m.figures[k], false); })
        .items.push_back({f.meaning});
  }
  const auto add = [&](const char* lead, const char* label, const char* meaning, const auto& text,
                       result::Audience seen = result::kPage) {
    Row& row =
        add_row(table, c, lead, label, text(c.native), {c.shadow.side ? text(*c.shadow.side) : ""},
                [&](const ComparedModel& m) { return text(m.run); });
    row.items.push_back({meaning});
    row.seen = seen;
  };
  add("* ", "settles to", "Motion in the last fifth of the run.",
      [](const Side& side) { return std::string(to_string(side.metrics.settled.attractor)); });
  for (const ResidualFigure& residual : residual_figures()) {
    add("  ", residual.law, residual.meaning, [&](const Side& side) {
      return fmt::format("{:.1e}", side.metrics.residuals.*residual.value);
    });
  }
  add(
      "  ", "time of a step, µs", "Median of repeated runs that record nothing.",
      [](const Side& side) { return is_timed(side) ? short_number(side.timing.median) : "–"; },
      result::kPeople);
  add("  ", "fastest and slowest, µs", "Of these repeated runs; the engines take turns.",
      [](const Side& side) {
        if (!is_timed(side)) return std::string("–");
        return fmt::format("{:.2g} – {:.2g}", side.timing.lowest, side.timing.highest);
      });
  add("  ", "steps", "Number of steps of the run shown.",
      [](const Side& side) { return fmt::format("{}", side.trajectory.steps); });
  add("  ", "real-time factor", "Simulated time divided by computing time.", [](const Side& side) {
    const double wall = 1e-6 * side.timing.median * static_cast<double>(side.trajectory.steps);
    return wall > 0.0 ? fmt::format("{:.3g}", side.trajectory.end / wall) : "–";
  });
  return table;
}

// In replay: the native figures that each contact model is compared with.
Table reference_table(const SceneComparison& c) {
  Table table = side_table(c, "native by commands of", "", "");
  table.seen = result::kTerminal;
  for (const Figure& f : figures()) {
    if (!f.is_judged()) continue;
    add_row(table, c, lead_of(f), figure_label(f), "", {}, [&](const ComparedModel& m) {
      return figure_value(f, f.value(c.reference(m).metrics));
    });
  }
  return table;
}

Table difference_table(const SceneComparison& c) {
  Table table = side_table(c, "difference from native", "", "shadow");
  table.place = "{column}/figures/{row}";
  for (std::size_t i = 0; i < figures().size(); ++i) {
    const Figure& f = figures()[i];
    Item shadow;
    if (c.shadow.side)
      shadow = {judged_json(c.shadow.figures[i], "shadow"), in_column(c.shadow.figures[i])};
    Row& row = add_row(table, c, lead_of(f), f.label, "", shadow, [&](const ComparedModel& m) {
      const FigureDifference& d = m.figures[i];
      return Item{difference_json(d), in_column(d)};
    });
    row.key = f.key;
    row.seen = !f.comparable || !is_shown(c, f) ? result::kJson : result::kNotPage;
  }
  return table;
}

// If twins scatter: half of the confidence interval of each difference, and the smallest difference
// that this number of twins can resolve.
std::vector<Part> interval_parts(const SceneComparison& c) {
  constexpr double kShown = 5e-5;
  Table table = side_table(c, "", "", "");
  table.seen = result::kTerminal;
  for (result::Column& column : table.columns) column.heading.clear();
  for (std::size_t i = 0; i < figures().size(); ++i) {
    const Figure& f = figures()[i];
    const bool scatters = std::ranges::any_of(
        c.models, [&](const ComparedModel& m) { return m.figures[i].interval >= kShown; });
    if (!f.is_judged() || !scatters) continue;
    const auto add = [&](const std::string& label, double FigureDifference::*size) {
      add_row(table, c, "  ", label, "", {}, [&](const ComparedModel& m) {
        const FigureDifference& d = m.figures[i];
        return in_column(size_text(d, d.*size));
      });
    };
    add(fmt::format("± {}", f.label), &FigureDifference::interval);
    add("  would be detected", &FigureDifference::least_detectable);
  }
  if (table.rows.empty()) return {};
  const auto runs = [](int twins) {
    return fmt::format("{} run{}", twins + 1, twins == 0 ? "" : "s");
  };
  const std::string meaning = fmt::format(
      "95 % confidence interval of the difference of means, from {} of native, {} of {} and one of "
      "each other. A difference as large as the row below would be detected in 4 of 5 comparisons.",
      runs(c.twins), runs(c.decider_twins), c.models.front().run.label);
  return {std::move(table), Sentence{.text = meaning, .lead = "  ± ", .seen = result::kTerminal}};
}

std::string settled_line(const SceneComparison& c) {
  const auto motion = [](const Side* side) -> std::string {
    return to_string(side->metrics.settled.attractor);
  };
  const auto sides = c.sides();
  const auto as_native = [&](const Side* side) { return motion(side) == motion(sides.front()); };
  if (std::ranges::all_of(sides, as_native))
    return fmt::format("{} (all runs)", motion(sides.front()));
  std::string text;
  for (const Side* side : sides)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", side->label, motion(side));
  return text;
}

// Describes the shadow, or says why there is none.
std::string shadow_note(const SceneComparison& c) {
  if (!c.shadow.side) return "no shadow: " + c.shadow.absent;
  const std::string what =
      fmt::format("shadow: native {} at MuJoCo's step", c.shadow.side->trajectory.integrator);
  if (!c.shadow.driven) {
    return what +
           ": its error is due to the step, and the rest of MuJoCo's error to the contact model";
  }
  return what + ", with the commands of " + c.models.front().run.label +
         ": its error is due to the step, and to drift because these commands do not react to it";
}

// When the rotors of native's twins, and of native and each MuJoCo run, move apart.
std::string divergence_text(const SceneComparison& c) {
  const auto part = [](const Divergence& d) {
    return d.time ? fmt::format("part by more than {:.3g} µm at t = {:.5g} s", 1e6 * d.threshold,
                                *d.time)
                  : fmt::format("never part by more than {:.3g} µm", 1e6 * d.threshold);
  };
  std::string text =
      "Rotor positions: native runs that start a few units in the last place apart " + part(c.twin);
  for (const ComparedModel& m : c.models)
    text += fmt::format("; native and {} {}", m.run.label, part(m.divergence));
  return text + ".";
}

// The causes of the difference of each figure. A terminal shows only the judged figures.
std::vector<Part> split_parts(const SceneComparison& c) {
  constexpr auto kTerminal = result::kTerminal, kPage = result::kPage;
  // An adaptive native step has no part in the differences, so it needs no column.
  int native_steps = result::kJson;
  Table table{"",
              {{"", "split of the difference", -30, kTerminal},
               {"", "figure", 0, kPage},
               {"", "MuJoCo", 0, kPage},
               {"", "difference", 10},
               {"", "contact model", 14},
               {"", "MuJoCo step", 12},
               {"", "native step", 12},
               {"", "repeated runs differ by", 10, kPage},
               {"", "uncertainty, or why it is not split", 0, kPage}}};
  bool unsure = false;
  for (const ComparedModel& m : c.models) {
    const std::string name = m.kind().heading;
    for (const FigureDifference& d : m.figures) {
      const Figure& f = *d.figure;
      if (!f.split || std::isnan(d.split.difference)) continue;
      if (!is_shown(c, f)) continue;
      const bool brief = f.is_judged() && !name.empty();
      unsure = unsure || (brief && !d.split.valid);
      Row row{.items = {{fmt::format("{:<9}{}", name, figure_label(f))},
                        {figure_label(f)},
                        {m.run.label}},
              .lead = d.split.valid ? "  " : "? ",
              .seen = brief ? result::kPeople : kPage};
      for (const double part :
           {d.split.difference, d.split.model_gap, d.split.step_error, d.split.native_step_error})
        row.items.push_back({figure_value(f, part)});
      if (figure_value(f, d.split.native_step_error) != "0") native_steps |= row.seen;
      row.items.push_back({size_text(d, d.interval)});
      row.items.push_back(
          {d.split.valid ? "± " + figure_value(f, d.split.uncertainty) : d.split.reason});
      table.rows.push_back(std::move(row));
    }
  }
  std::ranges::find(table.columns, "native step", &result::Column::heading)->seen =
      static_cast<result::Audience>(native_steps);
  // A terminal has no headings above nothing, as for a scene without contact.
  if (std::ranges::none_of(table.rows, [](const Row& row) { return row.seen == result::kPeople; }))
    table.seen = kPage;
  std::vector<Part> parts{std::move(table)};
  if (unsure) {
    parts.emplace_back(
        Sentence{.text = "  ? does not converge as the step shrinks, so the cause cannot be "
                         "determined",
                 .wraps = false,
                 .seen = kTerminal});
  }
  parts.emplace_back(Sentence{.text = divergence_text(c), .seen = kPage});
  return parts;
}

}  // namespace

Section figure_section(const SceneComparison& c) {
  const bool resync = c.mode == CompareMode::kResync;
  Section told{
      .parts = {Section{"", {value_table(c)}, result::kAll, "All figures", "figures"}, Sentence{}},
      .seen = resync ? result::kNotTerminal : result::kAll};
  const bool replayed = c.models.back().native.has_value();
  if (replayed) told.add({reference_table(c), Sentence{}});
  std::vector<Part> intervals = interval_parts(c);
  const std::string tolerance = percent_text(c.tolerance);
  std::string judged = "judged at " + tolerance;
  if (!intervals.empty()) judged += "; undecided if the confidence interval contains " + tolerance;
  if (replayed) judged += "; undecided if the drift of the open loop is larger than the difference";
  told.add({difference_table(c),
            Sentence{.text = "Differences without % are in the unit of the figure: percentage "
                             "points of shares of time, counts below 100, and values that are too "
                             "small for a percentage.",
                     .lead = "    ",
                     .seen = result::kTerminal},
            Sentence{.text = judged, .lead = "  * ", .seen = result::kTerminal}});
  told.add(std::move(intervals));
  told.add({Sentence{shadow_note(c), "  "},
            Sentence{.text = settled_line(c), .lead = "  settles to: ", .seen = result::kTerminal},
            Sentence{}});
  if (!resync)
    told.add({Section{"", split_parts(c), result::kAll, "Where the differences come from",
                      "differences"}});
  if (c.model_error) told.add({Sentence{}, model_error_section(*c.model_error)});
  return told;
}

}  // namespace rotorub
