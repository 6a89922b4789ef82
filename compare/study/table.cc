#include "compare/study/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/base/format.h"
#include "compare/figures/figure_text.h"
#include "compare/measured/table.h"
#include "compare/study/answer.h"
#include "compare/study/resync_text.h"
#include "compare/study/verdict.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

constexpr int kLabel = 24;
constexpr int kValue = 9;  // native, shadow and four contact models: 80 columns

std::string label_of(const Figure& f) {
  return *f.unit ? fmt::format("{}, {}", f.label, f.unit) : std::string(f.label);
}

// MuJoCo's defaults have their row in the answer, and their column in the report.
bool has_column(const Side& side) { return side.label != "cone-default"; }
const char* heading(const Side& side) {
  return side.label == "cone-coulomb" ? "cone-c" : side.label.c_str();
}

// "-0.24 pts" is as wide as a column.
std::string in_column(const JudgedFigure& f) {
  std::string text = f.is_absent() ? "–" : deviation_text(*f.figure, f.deviation);
  if (text.ends_with(" pts")) text.pop_back();
  return text;
}

// A line of texts below the columns: native, its shadow, MuJoCo's.
template <class Text, class OfShadow>
std::string line(const SceneComparison& c, const std::string& label, Text text,
                 OfShadow of_shadow) {
  std::string all = fmt::format("{:<{}}", label, kLabel + 2);
  for (std::size_t k = 0; k < c.sides.size(); ++k) {
    if (has_column(c.sides[k])) all += fmt::format("{:>{}}", text(k), kValue);
    if (k == 0 && c.shadow.side) all += fmt::format("{:>{}}", of_shadow(), kValue);
  }
  while (all.back() == ' ') all.pop_back();
  return all + "\n";
}

std::string marked(const Figure& f, const std::string& label) {
  return fmt::format("{} {}", f.is_judged() ? "*" : " ", label);
}

std::string value_lines(const SceneComparison& c) {
  std::string text = line(
      c, "", [&](std::size_t k) { return heading(c.sides[k]); }, [] { return "shadow"; });
  for (const Figure& f : figures()) {
    if (is_absent(c, f)) continue;
    text += line(
        c, marked(f, label_of(f)),
        [&](std::size_t k) { return figure_value(f, f.value(c.sides[k].metrics)); },
        [&] { return figure_value(f, f.value(c.shadow.side->metrics)); });
  }
  return text + line(
                    c, "  time of a step, µs",
                    [&](std::size_t k) { return short_number(c.sides[k].timing.median); },
                    [] { return ""; });
}

std::string difference_lines(const SceneComparison& c) {
  std::string text = line(
      c, "  difference from native",
      [&](std::size_t k) { return k == 0 ? "" : heading(c.sides[k]); }, [] { return "shadow"; });
  for (std::size_t i = 0; i < figures().size(); ++i) {
    const Figure& f = figures()[i];
    if (!f.comparable || is_absent(c, f)) continue;
    text += line(
        c, marked(f, f.label),
        [&](std::size_t k) {
          return k == 0 ? std::string() : in_column(c.differences[k - 1].figures[i]);
        },
        [&] { return in_column(c.shadow.figures[i]); });
  }
  return text;
}

// Where twins scatter: half of the confidence interval of each difference, and what that many twins
// would tell.
std::string interval_lines(const SceneComparison& c) {
  constexpr double kShown = 5e-5;
  std::string text;
  for (std::size_t i = 0; i < figures().size(); ++i) {
    const Figure& f = figures()[i];
    const auto of = [&](std::size_t k) -> const FigureDifference& {
      return c.differences[k - 1].figures[i];
    };
    bool scatters = false;
    for (std::size_t k = 1; k < c.sides.size(); ++k)
      scatters = scatters || of(k).interval >= kShown;
    if (!f.is_judged() || !scatters) continue;
    text += line(
        c, fmt::format("  ± {}", f.label),
        [&](std::size_t k) { return k == 0 ? std::string() : size_text(f, of(k).interval); },
        [] { return ""; });
    text += line(
        c, "    would be detected",
        [&](std::size_t k) { return k == 0 ? std::string() : size_text(f, of(k).least_told); },
        [] { return ""; });
  }
  if (text.empty()) return text;
  const auto runs = [](int twins) {
    return fmt::format("{} run{}", twins + 1, twins == 0 ? "" : "s");
  };
  return text +
         wrapped(
             "  ± ",
             fmt::format(
                 "95 % of the difference of means: {} of native, {} of {}, one of the others; a "
                 "difference as large as said below would be detected in 4 of 5 comparisons",
                 runs(c.twins), runs(c.decider_twins), c.sides[1].label));
}

// Replay: what the differences of each contact model are from.
std::string reference_lines(const SceneComparison& c) {
  if (c.natives.empty()) return "";
  std::string text = line(
      c, "  native by commands of",
      [&](std::size_t k) { return k == 0 ? "" : heading(c.sides[k]); }, [] { return ""; });
  for (const Figure& f : figures()) {
    if (!f.is_judged()) continue;
    text += line(
        c, marked(f, label_of(f)),
        [&](std::size_t k) {
          return k == 0 ? std::string() : figure_value(f, f.value(c.reference(k).metrics));
        },
        [] { return ""; });
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

// What the shadow is, or why there is none.
std::string shadow_note(const SceneComparison& c) {
  if (!c.shadow.side) return "no shadow: " + c.shadow.absent;
  const std::string what = fmt::format("shadow: the native stepper ({}) at MuJoCo's step",
                                       c.shadow.side->trajectory.integrator);
  if (!c.shadow.driven) {
    return what +
           ": what it is off by is the step's, what MuJoCo is off beyond it the contact "
           "model's";
  }
  return what + ", driven by the commands of " + c.sides[1].label +
         ": what it is off by is the step's, and what the open loop makes of it";
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
                          heading(c.sides[k + 1]), label_of(*d.figure), kLabel,
                          value(d.split.difference), value(d.split.model_gap),
                          value(d.split.step_error), value(d.split.native_step_error));
    }
  }
  if (unsure)
    text += "  ? does not converge as the step shrinks: whose part it is cannot be determined\n";
  return text;
}

// What was asked, answered: before any figure.
std::string answer_lines(const SceneComparison& c, const Palette& palette) {
  constexpr int kQuestion = 53, kTrust = 15;
  std::string text = fmt::format("  {:<{}}{:<{}}{}\n", "Can MuJoCo's contact forces be trusted?",
                                 kQuestion, "trusted", kTrust, "us a step");
  for (const AnswerRow& row : answer(c)) {
    const std::string cost = row.us_per_step > 0.0 ? short_number(row.us_per_step) : "-";
    const std::string line = fmt::format("{} {:<{}}{:<{}}{}\n", row.decides ? ">" : " ",
                                         row.question + "? (" + row.contact + ")", kQuestion,
                                         to_string(row.trust), kTrust, cost);
    text += palette.paint_first(tone_of(row.trust), line, to_string(row.trust)) +
            wrapped("      ", row.why);
  }
  text += wrapped("  > ", whose_verdict(c));
  for (const AnswerRow& row : answer(c)) {
    if (!row.evidence.empty()) text += wrapped("    ", row.evidence);
  }
  if (const std::string note = mode_note(c); !note.empty()) text += wrapped("    ", note);
  const std::vector<std::string> notes = own_notes(c);
  for (std::size_t k = 0; k < notes.size(); ++k)
    text += wrapped(k == 0 ? "    " : "    - ", notes[k]);
  return text;
}

// Before the headline of a contact model; all of one width.
const char* lead(Trust trust) {
  switch (trust) {
    case Trust::kYes:
      return "  within       ";
    case Trust::kAveragesOnly:
      return "  AVERAGES     ";
    case Trust::kUndecidable:
      return "  undecidable  ";
    case Trust::kNo:
      break;
  }
  return "  OUTSIDE      ";
}

}  // namespace

std::string comparison_table(const SceneComparison& c, const Palette& palette) {
  std::string text = fmt::format("{}: {}, step {}, {} simulated, scene {}\n", c.scene.name,
                                 to_string(c.mode), time_text(c.scene.run.step),
                                 time_text(c.scene.run.end), scene::scene_hash(c.scene));
  text += answer_lines(c, palette) + "\n";
  if (c.mode == CompareMode::kResync) {
    text += resync_table(c);
  } else {
    text += value_lines(c) + "\n" + reference_lines(c) + difference_lines(c);
    text += wrapped(
        "  * ",
        fmt::format(
            "judged at {}; decided where the difference is within it, or beyond it, with its ±{}",
            percent_text(c.tolerance),
            c.natives.empty() ? "" : ", no less than the open loop drifts by"));
    text += interval_lines(c);
    text += wrapped("  ", shadow_note(c));
    text += wrapped("  settles to: ", settled_line(c)) + "\n";
    text += split_lines(c);
    if (c.model_error) text += "\n" + model_error_table(*c.model_error, "  ");
  }
  if (c.measured) text += "\n" + measured_table(*c.measured);
  for (std::size_t k = 0; k < c.differences.size(); ++k) {
    const SideDifference& d = c.differences[k];
    text += "\n" + palette.paint_first(tone_of(d.trust),
                                       wrapped(lead(d.trust), headline(c, c.sides[k + 1], d)),
                                       lead(d.trust));
    for (const std::string& reason : d.reasons) text += wrapped("               - ", reason);
  }
  return text;
}

std::string run_table(const scene::Scene& scene, const Trajectory& t, const Palette& palette) {
  const Metrics m = metrics(t, contact_facts(scene));
  const std::string step = t.step > 0.0 ? "step " + time_text(t.step) : "steps of its own";
  std::string text = fmt::format(
      "{}: {}\n  {} {}, contact {}, {}, {} of {} simulated\n", scene.name,
      palette.paint(t.status == Status::kOk ? Tone::kGood : Tone::kBad, to_string(t.status)),
      t.engine, t.integrator, t.contact_model, step, time_text(t.end), time_text(scene.run.end));
  if (!t.message.empty()) text += wrapped("  ", t.message);
  if (m.first_touch) {
    text += fmt::format("  {:<{}}{:>{}}\n", "first touch, ms", kLabel,
                        short_number(1e3 * *m.first_touch), kValue);
  }
  if (m.least_gap && *m.least_gap > 0.0) {
    text += fmt::format("  {:<{}}{:>{}}\n", "least gap, µm", kLabel,
                        short_number(1e6 * *m.least_gap), kValue);
  }
  for (const Figure& f : figures()) {
    if (std::isnan(f.value(m))) continue;
    text +=
        fmt::format("  {:<{}}{:>{}}\n", label_of(f), kLabel, figure_value(f, f.value(m)), kValue);
  }
  text +=
      fmt::format("  {:<{}}{:>{}}\n", "settles to", kLabel, to_string(m.settled.attractor), kValue);
  text += fmt::format("  {:<{}}{:>{}}\n", "steps", kLabel, t.steps, kValue);
  text += fmt::format("  {:<{}}{:>{}}\n", "time of a step, µs", kLabel, short_number(m.us_per_step),
                      kValue);
  return text;
}

}  // namespace rotorub
