#include "compare/study/table.h"

#include <fmt/format.h>

#include "compare/study/answer.h"
#include "compare/study/format.h"
#include "compare/study/verdict.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

constexpr int kLabel = 27;
constexpr int kValue = 11;
constexpr int kDifference = 11;
constexpr std::size_t kWidth = 98;

std::string label_of(const Figure& f) {
  return *f.unit ? fmt::format("{}, {}", f.label, f.unit) : std::string(f.label);
}

std::string head(const SceneComparison& c) {
  std::string line = fmt::format("  {:<{}}", "", kLabel);
  for (std::size_t k = 0; k < c.sides.size(); ++k) {
    line += fmt::format("{:>{}}", c.sides[k].label, kValue);
    if (k > 0) line += fmt::format("{:>{}}", "difference", kDifference);
  }
  return line + "\n";
}

std::string figure_line(const SceneComparison& c, std::size_t index) {
  const Figure& f = figures()[index];
  std::string line = fmt::format("{} {:<{}}", f.is_judged() ? "*" : " ", label_of(f), kLabel);
  for (std::size_t k = 0; k < c.sides.size(); ++k) {
    line += fmt::format("{:>{}}", figure_value(f, f.value(c.sides[k].metrics)), kValue);
    if (k == 0) continue;
    const double apart = c.differences[k - 1].figures[index].deviation;
    line += fmt::format("{:>{}}", deviation_text(f, apart), kDifference);
  }
  return line + "\n";
}

// One line of texts below the sides' columns.
template <class Text>
std::string side_line(const SceneComparison& c, const char* label, Text text) {
  std::string line = fmt::format("  {:<{}}", label, kLabel);
  for (std::size_t k = 0; k < c.sides.size(); ++k) {
    line += fmt::format("{:>{}}", text(c.sides[k]), kValue);
    if (k > 0) line += std::string(kDifference, ' ');
  }
  while (line.back() == ' ') line.pop_back();
  return line + "\n";
}

std::string settled_line(const SceneComparison& c) {
  std::string line;
  for (const Side& side : c.sides) {
    line += fmt::format("{}{} {}", line.empty() ? "  settles to: " : ", ", side.label,
                        to_string(side.metrics.settled.attractor));
  }
  return line + "\n";
}

std::string split_lines(const SceneComparison& c) {
  std::string text =
      fmt::format("\n  {:<{}}{:>12}{:>16}{:>12}{:>12}\n", "split of the difference", kLabel + 10,
                  "difference", "contact model", "MuJoCo step", "native step");
  for (std::size_t k = 0; k < c.differences.size(); ++k) {
    for (const FigureDifference& d : c.differences[k].figures) {
      if (!d.figure->is_judged() || !d.figure->split) continue;
      const auto value = [&](double v) { return figure_value(*d.figure, v); };
      text += fmt::format("  {:<10}{:<{}}{:>12}{:>16}{:>12}{:>12}  {}\n", c.sides[k + 1].label,
                          label_of(*d.figure), kLabel, value(d.split.difference),
                          value(d.split.model_gap), value(d.split.step_error),
                          value(d.split.native_step_error), d.split.valid ? "" : "(not valid)");
    }
  }
  return text;
}

// A sentence in lines of at most kWidth, the first after `lead`, the others below it.
std::string wrapped(const std::string& lead, const std::string& sentence) {
  std::string out = lead;
  std::size_t column = lead.size();
  std::size_t at = 0;
  while (at < sentence.size()) {
    std::size_t end = sentence.find(' ', at);
    if (end == std::string::npos) end = sentence.size();
    const std::size_t word = end - at;
    if (column > lead.size() && column + 1 + word > kWidth) {
      out += "\n" + std::string(lead.size(), ' ');
      column = lead.size();
    } else if (column > lead.size()) {
      out += ' ';
      ++column;
    }
    out += sentence.substr(at, word);
    column += word;
    at = end + 1;
  }
  return out + "\n";
}

// What was asked, answered: before any figure.
std::string answer_lines(const SceneComparison& c) {
  constexpr int kContact = 10, kTrust = 15, kCost = 9;
  std::string text = fmt::format("  {:<{}}{:<{}}{:<{}}{}\n", "contact", kContact, "trusted", kTrust,
                                 "us a step", kCost + 2, "why");
  for (const AnswerRow& row : answer(c)) {
    const std::string cost = row.us_per_step > 0.0 ? short_number(row.us_per_step) : "-";
    text += wrapped(fmt::format("{} {:<{}}{:<{}}{:>{}}  ", row.decides ? ">" : " ", row.contact,
                                kContact, to_string(row.trust), kTrust, cost, kCost),
                    row.why);
  }
  return text + wrapped("  > ", whose_verdict(c));
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

std::string comparison_table(const SceneComparison& c) {
  std::string text = fmt::format("{}: step {}, {} simulated, scene {}\n", c.scene.name,
                                 time_text(c.scene.run.step), time_text(c.scene.run.end),
                                 scene::scene_hash(c.scene));
  text += answer_lines(c) + "\n";
  text += head(c);
  for (std::size_t k = 0; k < figures().size(); ++k) text += figure_line(c, k);
  text += side_line(c, "time of a step, µs",
                    [](const Side& s) { return short_number(s.timing.median); });
  text += fmt::format("  * judged: {}, or what {} twins spread by where that is more;\n"
                      "    rms gap rate relative to 1 mm/s at least\n",
                      percent_text(c.tolerance), c.twins);
  text += settled_line(c);
  text += split_lines(c);
  for (std::size_t k = 0; k < c.differences.size(); ++k) {
    const SideDifference& d = c.differences[k];
    text += "\n" + wrapped(lead(d.trust), headline(c, c.sides[k + 1], d));
    for (const std::string& reason : d.reasons) text += wrapped("               - ", reason);
  }
  return text;
}

std::string run_table(const scene::Scene& scene, const Trajectory& t) {
  const Metrics m = metrics(t, contact_facts(scene));
  std::string text =
      fmt::format("{}: {} {}, contact {}, step {}, {} of {} simulated, {}\n", scene.name, t.engine,
                  t.integrator, t.contact_model, time_text(t.step), time_text(t.end),
                  time_text(scene.run.end), to_string(t.status));
  if (!t.message.empty()) text += "  " + t.message + "\n";
  if (m.first_touch) {
    text += fmt::format("  {:<{}}{:>{}}\n", "first touch, ms", kLabel,
                        short_number(1e3 * *m.first_touch), kValue);
  }
  for (const Figure& f : figures()) {
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
