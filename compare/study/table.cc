#include "compare/study/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compare/base/format.h"
#include "compare/figures/figure.h"
#include "compare/measured/output.h"
#include "compare/run_files/doubts.h"
#include "compare/study/answer.h"
#include "compare/study/resync_text.h"
#include "compare/study/verdict.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

constexpr int kLabel = 24;
constexpr int kValue = 9;  // with native, shadow and four contact models: 80 columns

std::string heading(const Side& side) { return column_heading(side.label); }
bool has_column(const Side& side) { return !heading(side).empty(); }

// The column omits the unit "points"; the line below the differences states it.
std::string in_column(const std::string& text) { return text.substr(0, text.find(" points")); }
std::string in_column(const JudgedFigure& f) {
  return f.is_absent() ? "–" : in_column(deviation_text(f));
}

// A line of texts below the columns: of native, of its shadow if there is one, and of each MuJoCo
// side by its index.
template <class Mujoco>
std::string line(const SceneComparison& c, const std::string& label, const std::string& native,
                 const std::string& shadow, Mujoco mujoco) {
  std::string all = fmt::format("{:<{}}{:>{}}", label, kLabel + 2, native, kValue);
  if (c.shadow.side) all += fmt::format("{:>{}}", shadow, kValue);
  for (std::size_t k = 1; k < c.sides.size(); ++k) {
    if (has_column(c.sides[k])) all += fmt::format("{:>{}}", mujoco(k), kValue);
  }
  all.erase(all.find_last_not_of(' ') + 1);
  return all + "\n";
}

std::string heading_line(const SceneComparison& c, const std::string& label,
                         const std::string& native, const std::string& shadow) {
  return line(c, label, native, shadow, [&](std::size_t k) { return heading(c.sides[k]); });
}

std::string marked(const Figure& f, const std::string& label) {
  return fmt::format("{} {}", f.is_judged() ? "*" : " ", label);
}

std::string value_lines(const SceneComparison& c) {
  std::string text = heading_line(c, "", "native", "shadow");
  for (const Figure& f : figures()) {
    if (is_absent(c, f)) continue;
    const auto of = [&](const Side& side) { return figure_value(f, f.value(side.metrics)); };
    text +=
        line(c, marked(f, figure_label(f)), of(c.sides[0]), c.shadow.side ? of(*c.shadow.side) : "",
             [&](std::size_t k) { return of(c.sides[k]); });
  }
  const auto cost = [](const Side& side) { return short_number(side.timing.median); };
  return text + line(c, "  time of a step, µs", cost(c.sides[0]), "",
                     [&](std::size_t k) { return cost(c.sides[k]); });
}

std::string difference_lines(const SceneComparison& c) {
  std::string text = heading_line(c, "  difference from native", "", "shadow");
  for (std::size_t i = 0; i < figures().size(); ++i) {
    const Figure& f = figures()[i];
    if (!f.comparable || is_absent(c, f)) continue;
    text += line(c, marked(f, f.label), "", c.shadow.side ? in_column(c.shadow.figures[i]) : "",
                 [&](std::size_t k) { return in_column(c.differences[k - 1].figures[i]); });
  }
  return text +
         wrapped("    ",
                 "Differences without a unit are percentage points of shares of time, and whole "
                 "numbers of counts below 100.");
}

// If twins scatter: half of the confidence interval of each difference, and the smallest difference
// that this number of twins can resolve.
std::string interval_lines(const SceneComparison& c) {
  constexpr double kShown = 5e-5;
  std::string text;
  for (std::size_t i = 0; i < figures().size(); ++i) {
    const Figure& f = figures()[i];
    const bool scatters =
        std::any_of(c.differences.begin(), c.differences.end(),
                    [&](const SideDifference& d) { return d.figures[i].interval >= kShown; });
    if (!f.is_judged() || !scatters) continue;
    const auto add = [&](const std::string& label, double FigureDifference::*size) {
      text += line(c, label, "", "", [&](std::size_t k) {
        const FigureDifference& d = c.differences[k - 1].figures[i];
        return in_column(size_text(d, d.*size));
      });
    };
    add(fmt::format("  ± {}", f.label), &FigureDifference::interval);
    add("    would be detected", &FigureDifference::least_told);
  }
  if (text.empty()) return text;
  const auto runs = [](int twins) {
    return fmt::format("{} run{}", twins + 1, twins == 0 ? "" : "s");
  };
  return text +
         wrapped("  ± ",
                 fmt::format("95 % confidence interval of the difference of means, from {} of "
                             "native, {} of {} and one of each other. A difference as large as the "
                             "row below would be detected in 4 of 5 comparisons.",
                             runs(c.twins), runs(c.decider_twins), c.sides[1].label));
}

// In replay: the native figures that each contact model is compared with.
std::string reference_lines(const SceneComparison& c) {
  if (c.natives.empty()) return "";
  std::string text = heading_line(c, "  native by commands of", "", "");
  for (const Figure& f : figures()) {
    if (!f.is_judged()) continue;
    text += line(c, marked(f, figure_label(f)), "", "",
                 [&](std::size_t k) { return figure_value(f, f.value(c.reference(k).metrics)); });
  }
  return text + "\n";
}

std::string settled_line(const SceneComparison& c) {
  std::string text;
  for (const Side& side : c.sides) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", side.label,
                        to_string(side.metrics.settled.attractor));
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
  return what + ", driven by the commands of " + c.sides[1].label +
         ": its error is due to the step, and to what the open loop makes of it";
}

std::string split_lines(const SceneComparison& c) {
  std::string text =
      fmt::format("  {:<{}}{:>11}{:>10}{:>10}{:>10}\n", "split of the difference, due to",
                  kLabel + 9, "difference", "contact", "step", "native");
  bool unsure = false;
  for (std::size_t k = 0; k < c.differences.size(); ++k) {
    if (!has_column(c.sides[k + 1])) continue;
    for (const FigureDifference& d : c.differences[k].figures) {
      if (!d.figure->is_judged() || !d.figure->split || is_absent(c, *d.figure)) continue;
      const auto value = [&](double v) { return figure_value(*d.figure, v); };
      unsure = unsure || !d.split.valid;
      text += fmt::format("{} {:<9}{:<{}}{:>11}{:>10}{:>10}{:>10}\n", d.split.valid ? " " : "?",
                          heading(c.sides[k + 1]), figure_label(*d.figure), kLabel,
                          value(d.split.difference), value(d.split.model_gap),
                          value(d.split.step_error), value(d.split.native_step_error));
    }
  }
  if (unsure)
    text += "  ? does not converge as the step shrinks, so the cause cannot be determined\n";
  return text;
}

// The answer to the user's question, before any figure.
std::string answer_lines(const SceneComparison& c, const Palette& palette) {
  constexpr int kQuestion = 53, kTrust = 15;
  std::string text = fmt::format("  {:<{}}{:<{}}{}\n", "Can MuJoCo's contact forces be trusted?",
                                 kQuestion, "trusted", kTrust, "us a step");
  const std::vector<AnswerRow> rows = answer(c);
  const std::vector<std::size_t> order = reading_order(c);
  for (const std::size_t k : order) {
    const AnswerRow& row = rows[k];
    const std::string cost = row.us_per_step > 0.0 ? short_number(row.us_per_step) : "-";
    const std::string line =
        fmt::format("{} {:<{}}{:<{}}{}\n", row.decides ? ">" : " ",
                    row.question + "? (" + row.contact + ")", kQuestion, row.trusted, kTrust, cost);
    text += palette.paint_first(row.tone, line, row.trusted) + wrapped("      ", row.why);
  }
  text += wrapped("  > ", whose_verdict(c));
  for (const AnswerRow& row : rows) {
    if (!row.evidence.empty()) text += wrapped("    ", row.evidence);
  }
  for (const std::string& note : {cone_note(c), solref_note(c), mode_note(c)})
    if (!note.empty()) text += wrapped("    ", note);
  const std::vector<std::string> notes = own_notes(c);
  for (std::size_t k = 0; k < notes.size(); ++k)
    text += wrapped(k == 0 ? "    " : "    - ", notes[k]);
  return text;
}

// Text before the headline of a contact model, in the order of Trust; equal widths.
constexpr const char* kLeads[] = {"  within       ", "  AVERAGES     ", "  OUTSIDE      ",
                                  "  undecidable  "};
constexpr const char* kNoLead = "  not judged   ";

}  // namespace

std::string comparison_table(const SceneComparison& c, const Palette& palette) {
  std::string text =
      fmt::format("{}: {}, step {}, {} simulated, scene {}\n", scene::printable(c.scene.name),
                  to_string(c.mode), time_text(c.scene.run.step), time_text(c.scene.run.end),
                  scene::scene_hash(c.scene));
  text += answer_lines(c, palette) + "\n";
  if (c.mode == CompareMode::kResync) {
    text += resync_table(c);
  } else {
    text += value_lines(c) + "\n" + reference_lines(c) + difference_lines(c);
    text += wrapped(
        "  * ",
        fmt::format("judged at {}: decided where the difference with all of its ± lies within "
                    "that, or beyond it{}",
                    percent_text(c.tolerance),
                    c.natives.empty() ? "" : ", and is no less than the drift of the open loop"));
    text += interval_lines(c);
    text += wrapped("  ", shadow_note(c));
    text += wrapped("  settles to: ", settled_line(c)) + "\n";
    text += split_lines(c);
    if (c.model_error) text += "\n" + model_error_table(*c.model_error, "  ");
  }
  if (c.measured) text += "\n" + measured_table(*c.measured);
  for (const std::size_t k : reading_order(c)) {
    const SideDifference& d = c.differences[k];
    const bool told = showing(c, k + 1) == Showing::kForces;
    const char* lead = told ? kLeads[static_cast<int>(d.trust)] : kNoLead;
    text += "\n" + palette.paint_first(told ? tone_of(d.trust) : Tone::kPart,
                                       wrapped(lead, headline(c, c.sides[k + 1], d)), lead);
    for (const std::string& reason : d.reasons) text += wrapped("               - ", reason);
  }
  return text;
}

std::string rub_answer(const Metrics& m, std::optional<double> cut) {
  if (!m.first_touch && cut)
    return fmt::format("not until {} ms, where the run was cut short", short_number(1e3 * *cut));
  if (!m.first_touch) {
    if (!m.least_gap) return "no, rotor and ring do not touch";
    return fmt::format("no, the rotor stays {} µm clear of the ring",
                       short_number(1e6 * *m.least_gap));
  }
  std::string text = fmt::format("yes, from {} ms", short_number(1e3 * *m.first_touch));
  if (m.hard_impacts > 0)
    text += fmt::format(": {} hard impact{}", m.hard_impacts, m.hard_impacts > 1 ? "s" : "");
  const Attractor last = m.settled.attractor;
  if (last == Attractor::kNoContact) {
    text += ", and no contact any more at its end";
  } else if (last != Attractor::kUnknown) {
    text += fmt::format(", {} in the last fifth of the run", described(m.settled));
  }
  return text + fmt::format("; mean normal force {} N", short_number(m.mean_force));
}

std::string run_table(const scene::Scene& scene, const Trajectory& t, const Palette& palette) {
  const Metrics m = metrics(t, contact_facts(scene));
  const std::string step = t.step > 0.0 ? "step " + time_text(t.step) : "steps of its own";
  std::string text = fmt::format(
      "{}: {}\n  {} {}, contact {}, {}, {} of {} simulated\n", scene::printable(scene.name),
      palette.paint(t.status == Status::kOk ? Tone::kGood : Tone::kBad, to_string(t.status)),
      t.engine, t.integrator, t.contact_model, step, time_text(t.end), time_text(scene.run.end));
  // In both units, because 3600 without a unit is read as rad/s, whatever the user meant.
  const double speed = scene.rotor.speed;
  text += fmt::format("  rotor at {} rad/s, {} rpm{}\n", short_number(speed),
                      short_number(speed * 30.0 / std::numbers::pi),
                      scene.drive ? " at its start" : "");
  if (!t.message.empty()) text += wrapped("  ", t.message);
  for (const std::string& doubt : doubts(scene, t)) text += wrapped("  warning: ", doubt);
  if (!contact_facts(scene).empty())
    text += wrapped("  rubs: ",
                    rub_answer(m, t.status == Status::kOk ? std::optional<double>() : t.end));
  const auto add = [&](const std::string& label, const std::string& value) {
    text += fmt::format("  {:<{}}{:>{}}\n", label, kLabel, value, kValue);
  };
  if (m.first_touch) add("first touch, ms", short_number(1e3 * *m.first_touch));
  // Without a contact, the figures of contact are 0, and their rows are left out.
  for (const Figure& f : figures()) {
    const double value = f.value(m);
    if (has_figure(m, f) && (m.first_touch || value != 0.0)) {
      add(figure_label(f), figure_value(f, value));
    }
  }
  add("settles to", to_string(m.settled.attractor));
  add("steps", fmt::format("{}", t.steps));
  add("time of a step, µs", short_number(m.us_per_step));
  return text;
}

}  // namespace rotorub
