#include "compare/study/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "compare/base/columns.h"
#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/base/version.h"
#include "compare/figures/figure.h"
#include "compare/measured/output.h"
#include "compare/model_error/model_error.h"
#include "compare/run_files/summary.h"
#include "compare/study/answer.h"
#include "compare/study/resync_text.h"
#include "compare/study/verdict.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"

namespace rotorub {

// Structs that are written to JSON member by member.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Extrapolation, values, limit, order, uncertainty, valid, reason)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Split, model_gap, step_error, native_step_error, uncertainty,
                                   valid, reason)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Impact, t, normal_impulse, friction_impulse)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Timing, us_per_step, median, lowest, highest)

namespace {

using nlohmann::json;
using result::Data, result::Item, result::Part, result::Row, result::Section, result::Sentence,
    result::Table;

json divergence_json(const Divergence& d) {
  return {{"threshold", d.threshold},
          {"time", number_or_null(d.time)},
          {"max_distance", d.max_distance},
          {"rms_distance", d.rms_distance}};
}

json side_json(const scene::Scene& scene, const Side& side) {
  json limits = json::object();
  for (std::size_t k = 0; k < side.limits.size(); ++k) {
    if (figures()[k].split) limits[figures()[k].key] = side.limits[k];
  }
  return {{"engine", side.engine},
          {"solref", side.solref.empty() ? json(nullptr) : json(side.solref)},
          {"summary", summary_json(scene, side.trajectory)},
          {"metrics", metrics_json(side.metrics)},
          {"step_to_zero", limits},
          {"timing", side.timing}};
}

// Without a shadow: null figures and a reason.
json shadow_json(const SceneComparison& c) {
  if (!c.shadow.side) return {{"figures", nullptr}, {"reason", c.shadow.absent}};
  return {{"engine", c.shadow.side->engine},
          {"commands_of", c.shadow.driven ? json(c.models.front().run.label) : json(nullptr)},
          {"summary", summary_json(c.scene, c.shadow.side->trajectory)}};
}

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
              {"least_told", f.least_told},
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
  Table table{"", {{"", label, -26}, {"", native, kValue}}};
  if (c.shadow.side) table.columns.push_back({"shadow", shadow, kValue});
  for (const ComparedModel& m : c.models) {
    const std::string name = m.kind().heading;
    table.columns.push_back(
        {"differences/" + m.run.label, name, kValue, name.empty() ? result::kJson : result::kAll});
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

// The column omits the unit "points"; the line below the differences states it.
std::string in_column(const std::string& text) { return text.substr(0, text.find(" points")); }
std::string in_column(const JudgedFigure& f) {
  return f.is_absent() ? "–" : in_column(deviation_text(f));
}

// The answer to the user's question, one row per contact model.
Table answer_table(const SceneComparison& c, const std::vector<AnswerRow>& rows) {
  Table table{"answer/#/{column}",
              {{"question", "Can MuJoCo's contact forces be trusted?", -55},
               {"trusted", "trusted", -15},
               {"us_per_step", "µs a step"}}};
  for (const AnswerRow& row : rows) {
    const bool timed = row.us_per_step > 0.0;
    table.rows.push_back(
        {.items = {{row.question, row.question + "? (" + row.contact + ")"},
                   {row.verdict.word, "", row.verdict.tone},
                   {timed ? json(row.us_per_step) : json(nullptr), timed ? "" : "-"}},
         .lead = row.decides ? "> " : "  ",
         .note = {row.why, "      "},
         .data = {{"scene", c.scene.name},
                  {"contact", row.contact},
                  {"why", row.why},
                  {"decides_exit_code", row.decides},
                  {"evidence", row.evidence.empty() ? json(nullptr) : json(row.evidence)}}});
  }
  return table;
}

// Before any figure. People read the rows in another order than JSON has them.
std::vector<Part> answer_parts(const SceneComparison& c) {
  std::vector<AnswerRow> rows;
  for (const ComparedModel* m : reading_order(c)) rows.push_back(answer_row(c, *m));
  Table written = answer_table(c, answer(c)), shown = answer_table(c, rows);
  written.seen = result::kJson;
  shown.seen = result::kPeople;
  std::vector<Part> parts{std::move(written), std::move(shown), Sentence{whose_verdict(c), "  > "}};
  const auto add = [&](const std::string& text, const char* lead = "    ") {
    if (!text.empty()) parts.emplace_back(Sentence{text, lead});
  };
  for (const AnswerRow& row : rows) add(row.evidence);
  for (const std::string& text : {cone_note(c), solref_note(c), mode_note(c)}) add(text);
  const std::vector<std::string> notes = own_notes(c);
  for (std::size_t k = 0; k < notes.size(); ++k) add(notes[k], k == 0 ? "    " : "    - ");
  return parts;
}

Table value_table(const SceneComparison& c) {
  Table table = side_table(c, "", "native", "shadow");
  for (const Figure& f : figures()) {
    if (is_absent(c, f)) continue;
    const auto of = [&](const Side& side) { return figure_value(f, f.value(side.metrics)); };
    add_row(table, c, lead_of(f), figure_label(f), of(c.native),
            {c.shadow.side ? of(*c.shadow.side) : ""},
            [&](const ComparedModel& m) { return of(m.run); });
  }
  const auto cost = [](const Side& side) { return short_number(side.timing.median); };
  add_row(table, c, "  ", "time of a step, µs", cost(c.native), {},
          [&](const ComparedModel& m) { return cost(m.run); });
  return table;
}

// In replay: the native figures that each contact model is compared with.
Table reference_table(const SceneComparison& c) {
  Table table = side_table(c, "native by commands of", "", "");
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
    if (!f.comparable || is_absent(c, f)) row.seen = result::kJson;
  }
  return table;
}

// If twins scatter: half of the confidence interval of each difference, and the smallest difference
// that this number of twins can resolve.
std::vector<Part> interval_parts(const SceneComparison& c) {
  constexpr double kShown = 5e-5;
  Table table = side_table(c, "", "", "");
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
    add("  would be detected", &FigureDifference::least_told);
  }
  if (table.rows.empty()) return {};
  const auto runs = [](int twins) {
    return fmt::format("{} run{}", twins + 1, twins == 0 ? "" : "s");
  };
  const std::string meaning = fmt::format(
      "95 % confidence interval of the difference of means, from {} of native, {} of {} and one of "
      "each other. A difference as large as the row below would be detected in 4 of 5 comparisons.",
      runs(c.twins), runs(c.decider_twins), c.models.front().run.label);
  return {std::move(table), Sentence{meaning, "  ± "}};
}

std::string settled_line(const SceneComparison& c) {
  std::string text;
  for (const Side* side : c.sides()) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", side->label,
                        to_string(side->metrics.settled.attractor));
  }
  return text;
}

// Describes the shadow, or says why there is none.
std::string shadow_note(const SceneComparison& c) {
  if (!c.shadow.side) return "no shadow: " + c.shadow.absent;
  const std::string what = fmt::format("shadow: the native stepper ({}) at MuJoCo's step",
                                       c.shadow.side->trajectory.integrator);
  if (!c.shadow.driven) {
    return what +
           ": its error is due to the step, and the rest of MuJoCo's error to the contact model";
  }
  return what + ", driven by the commands of " + c.models.front().run.label +
         ": its error is due to the step, and to what the open loop makes of it";
}

std::vector<Part> split_parts(const SceneComparison& c) {
  Table table{"",
              {{"", "split of the difference, due to", -35},
               {"", "difference", 11},
               {"", "contact", 10},
               {"", "step", 10},
               {"", "native", 10}}};
  bool unsure = false;
  for (const ComparedModel& m : c.models) {
    const std::string name = m.kind().heading;
    if (name.empty()) continue;
    for (const FigureDifference& d : m.figures) {
      if (!d.figure->is_judged() || !d.figure->split || is_absent(c, *d.figure)) continue;
      unsure = unsure || !d.split.valid;
      Row row{.items = {{fmt::format("{:<9}{}", name, figure_label(*d.figure))}},
              .lead = d.split.valid ? "  " : "? "};
      for (const double part :
           {d.split.difference, d.split.model_gap, d.split.step_error, d.split.native_step_error})
        row.items.push_back({figure_value(*d.figure, part)});
      table.rows.push_back(std::move(row));
    }
  }
  std::vector<Part> parts{std::move(table)};
  if (unsure) {
    parts.emplace_back(result::line(
        "  ? does not converge as the step shrinks, so the cause cannot be determined"));
  }
  return parts;
}

// The figures of all runs and their differences. People read the single contacts instead in resync.
Section figure_section(const SceneComparison& c) {
  Section told{.parts = {value_table(c), Sentence{}},
               .seen = c.mode == CompareMode::kResync ? result::kJson : result::kAll};
  const bool replayed = c.models.back().native.has_value();
  if (replayed) told.add({reference_table(c), Sentence{}});
  const std::string judged = fmt::format(
      "judged at {}: decided where the difference with all of its ± lies within that, or beyond "
      "it{}",
      percent_text(c.tolerance),
      replayed ? ", and is no less than the drift of the open loop" : "");
  told.add({difference_table(c),
            Sentence{"Differences without a unit are percentage points of shares of time, and "
                     "whole numbers of counts below 100.",
                     "    "},
            Sentence{judged, "  * "}});
  told.add(interval_parts(c));
  told.add(
      {Sentence{shadow_note(c), "  "}, Sentence{settled_line(c), "  settles to: "}, Sentence{}});
  told.add(split_parts(c));
  if (c.model_error) told.add({Sentence{}, model_error_section(*c.model_error)});
  return told;
}

// The verdict on one contact model with its reasons.
std::vector<Part> verdict_parts(const SceneComparison& c, const ComparedModel& m) {
  const auto impact = [](const std::optional<Impact>& one) { return one ? json(*one) : json(); };
  json impacts = json::array();
  for (const ImpactPair& pair : m.impacts)
    impacts.push_back({{"native", impact(pair.a)}, {"other", impact(pair.b)}});
  const VerdictWords& words = verdict_words(c, m);
  Section verdict{"differences/" + m.run.label,
                  {Data{"",
                        {{"within", m.within()},
                         {"trusted", to_string(m.trust)},
                         {"decides", c.decides(m)},
                         {"reasons", m.reasons},
                         {"divergence", divergence_json(m.divergence)},
                         {"impacts", impacts}}},
                   Sentence{.text = headline(c, m),
                            .lead = fmt::format("  {:<13}", words.lead),
                            .tone = words.tone,
                            .place = "headline"}}};
  for (const std::string& reason : m.reasons) verdict.add({Sentence{reason, "               - "}});
  return {Sentence{}, std::move(verdict)};
}

// The keys that the terminal does not have, and the places of the other parts.
Data scene_data(const SceneComparison& c) {
  json sides = json::object();
  for (const Side* side : c.sides()) sides[side->label] = side_json(c.scene, *side);
  return {"",
          {{"mode", to_string(c.mode)},
           {"mode_note", mode_note(c)},
           {"twins", c.twins},
           {"shadow", shadow_json(c)},
           {"own_model", c.own ? json{{"left_out", c.twin_limits}} : json(nullptr)},
           {"scene", c.scene.name},
           {"scene_hash", scene::scene_hash(c.scene)},
           {"step", c.scene.run.step},
           {"end", c.scene.run.end},
           {"status", to_string(c.status())},
           {"within", c.within()},
           {"model_error", nullptr},
           {"measured", nullptr},
           {"runs", sides},
           {"differences", json::object()},
           {"twin", divergence_json(c.twin)}}};
}

}  // namespace

nlohmann::ordered_json compare_columns_json() {
  return {{"compare.json runs.*.metrics", columns_json(metric_keys())},
          {"compare.json runs.*.summary", columns_json(summary_keys())},
          {"compare.json measured", columns_json(measured_keys())}};
}

Section comparison_result(const SceneComparison& c) {
  Section told{.parts = {scene_data(c)}};
  told.add({result::line(fmt::format(
      "{}: {}, step {}, {} simulated, scene {}", scene::printable(c.scene.name), to_string(c.mode),
      time_text(c.scene.run.step), time_text(c.scene.run.end), scene::scene_hash(c.scene)))});
  told.add(answer_parts(c));
  told.add({Sentence{}});
  if (c.mode == CompareMode::kResync) told.add(resync_parts(c));
  told.add({figure_section(c)});
  if (c.measured) told.add({Sentence{}, measured_section(*c.measured)});
  for (const ComparedModel* m : reading_order(c)) told.add(verdict_parts(c, *m));
  return told;
}

Section comparisons_result(const std::vector<SceneComparison>& comparisons) {
  const bool any = !comparisons.empty();
  Section told{
      .parts = {Data{"",
                     {{"answer", json::array()},  // sorts first, so the file begins with it
                      {"program", "rotorub"},
                      {"version", program_version()},
                      {"mujoco_version", mujoco_version()},
                      {"mode", to_string(any ? comparisons.front().mode : CompareMode::kLockstep)},
                      {"contact", to_string(kDefaultContact)},
                      {"tolerance", any ? comparisons.front().tolerance : 0.0},
                      {"within", any && std::ranges::all_of(comparisons, &SceneComparison::within)},
                      {"scenes", json::array()}}}},
      .seen = result::kJson};
  for (const SceneComparison& c : comparisons) {
    told.add({Data{"contact", c.models.front().run.label}});
    Section scene = comparison_result(c);
    scene.place = "scenes/#";
    told.add({answer_table(c, answer(c)), std::move(scene)});
  }
  return told;
}

}  // namespace rotorub
