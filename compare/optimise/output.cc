#include "compare/optimise/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "compare/base/columns.h"
#include "compare/base/format.h"
#include "compare/figures/figure.h"
#include "compare/sweep/folder.h"
#include "compare/sweep/sample.h"
#include "native_model/scene/text.h"
#include "native_model/trajectory/output.h"

namespace rotorub::optimise {
namespace {

using nlohmann::ordered_json;

const char* goal_word(const Goal& goal) { return goal.maximise ? "maximise" : "minimise"; }

std::string field(const std::optional<double>& value) {
  std::string text;
  if (value) append_number(text, *value);
  return text;
}

// The SI unit of the figure with a space before it; empty if dimensionless, and for figures of
// modes.
std::string unit_of(const FigurePath& figure) {
  if (figure.source != Source::kRun) return {};
  const auto keys = metric_keys();
  const auto key = std::ranges::find(keys, std::string_view(figure.text), &ColumnMeaning::name);
  return key == keys.end() || key->unit.empty() ? std::string() : " " + std::string(key->unit);
}

enum class End { kNone, kLower, kUpper };

// The end of its range that a key's value has reached, within a margin, because the search stops
// some tolerances away.
End end_of(const Task& task, std::size_t key, double value) {
  const sweep::Vary& vary = task.study.vary[key];
  const double near = std::clamp(10.0 * task.goal.tolerance, 1e-9, 0.01);
  const bool rises = vary.to > vary.from;
  const double from = sweep::between(vary, near), to = sweep::between(vary, 1.0 - near);
  if (rises ? value <= from : value >= from) return rises ? End::kLower : End::kUpper;
  if (rises ? value >= to : value <= to) return rises ? End::kUpper : End::kLower;
  return End::kNone;
}

std::string nothing_text(const Optimum& optimum) {
  const Evaluation* nearest = nullptr;
  for (const Evaluation& e : optimum.evaluations) {
    if (e.ok() && (!nearest || e.violation < nearest->violation)) nearest = &e;
  }
  if (!nearest) {
    const bool any = !optimum.evaluations.empty();
    return "  none of them runs" + (any ? ": " + optimum.evaluations.back().reason : "") + "\n";
  }
  return fmt::format(
      "  none of them keeps the constraints; the nearest, evaluation {}, breaks one by "
      "{:.3g} % of its limit\n",
      nearest - optimum.evaluations.data(), 100.0 * nearest->violation);
}

}  // namespace

std::string edge_text(const Task& task, const Optimum& optimum) {
  std::string text;
  if (!optimum.best) return text;
  const Evaluation& best = optimum.evaluations[*optimum.best];
  for (std::size_t k = 0; k < best.values.size(); ++k) {
    const End end = end_of(task, k, best.values[k]);
    if (end == End::kNone) continue;
    text += fmt::format("{}{} end of the range of {}", text.empty() ? "at the " : " and the ",
                        end == End::kLower ? "lower" : "upper", task.study.vary[k].key);
  }
  return text.empty() ? text : text + ": a wider range may hold better values";
}

std::string constraint_text(const Constraint& c) {
  return fmt::format("{} {} {}", c.figure.text, c.is_max ? "<=" : ">=", short_number(c.limit));
}

ordered_json optimum_json(const Task& task, const Optimum& optimum) {
  ordered_json all{{"figure", task.goal.figure.text},
                   {"goal", goal_word(task.goal)},
                   {"ending", to_string(optimum.ending)},
                   {"evaluations", optimum.evaluations.size()},
                   {"best", nullptr}};
  if (!optimum.best) return all;
  const Evaluation& best = optimum.evaluations[*optimum.best];
  auto values = ordered_json::object();
  for (std::size_t k = 0; k < best.values.size(); ++k)
    values[task.study.vary[k].key] = best.values[k];
  const std::string edge = edge_text(task, optimum);
  auto constraints = ordered_json::array();
  for (std::size_t k = 0; k < best.constraints.size(); ++k) {
    const Constraint& c = task.goal.constraints[k];
    constraints.push_back({{"figure", c.figure.text},
                           {c.is_max ? "max" : "min", c.limit},
                           {"value", *best.constraints[k]}});
  }
  all["best"] = {{"evaluation", *optimum.best},
                 {"values", values},
                 {"edge", edge.empty() ? ordered_json(nullptr) : ordered_json(edge)},
                 {"figure", *best.figure},
                 {"constraints", constraints}};
  return all;
}

std::string evaluations_csv(const Task& task, const Optimum& optimum) {
  std::string text = "evaluation";
  for (const sweep::Vary& vary : task.study.vary) text += "," + sweep::csv_field(vary.key);
  text += "," + sweep::csv_field(task.goal.figure.text);
  for (const Constraint& c : task.goal.constraints) text += "," + sweep::csv_field(c.figure.text);
  text += ",violation,status,reason\n";
  for (std::size_t i = 0; i < optimum.evaluations.size(); ++i) {
    const Evaluation& e = optimum.evaluations[i];
    text += std::to_string(i);
    for (const double value : e.values) text += "," + field(value);
    text += "," + field(e.figure);
    for (const auto& value : e.constraints) text += "," + field(value);
    text += fmt::format(",{},{},{}\n", field(e.violation), e.status, sweep::csv_field(e.reason));
  }
  return text;
}

ordered_json evaluations_columns_json(const Task& task) {
  auto all = ordered_json::array();
  all.push_back(column_json("evaluation", "", "number in the order of the search, from 0"));
  for (const sweep::Vary& vary : task.study.vary)
    all.push_back(column_json(vary.key, vary.unit, "value of the key"));
  all.push_back(column_json(task.goal.figure.text, "SI", "figure that the study optimises"));
  for (const Constraint& c : task.goal.constraints)
    all.push_back(column_json(c.figure.text, "SI", "figure of a constraint"));
  all.push_back(column_json("violation", "",
                            "most by which a constraint is broken, as a share of its limit"));
  all.push_back(column_json("status", "", "ok, of a run, or refused"));
  all.push_back(column_json("reason", "", "why it is not ok"));
  return {{"evaluations.csv", all}};
}

std::string optimum_text(const std::string& name, const Task& task, const Optimum& optimum) {
  std::string text = fmt::format("{}: {} {}\n", scene::printable(name), goal_word(task.goal),
                                 scene::printable(task.goal.figure.text));
  const std::string edge = edge_text(task, optimum);
  text += wrapped("  ", fmt::format("{} evaluations, {}{}{}", optimum.evaluations.size(),
                                    to_string(optimum.ending), edge.empty() ? "" : ", ", edge));
  if (!optimum.best) return text + nothing_text(optimum);
  const Evaluation& best = optimum.evaluations[*optimum.best];
  for (std::size_t k = 0; k < best.values.size(); ++k) {
    const sweep::Vary& vary = task.study.vary[k];
    const bool at_end = end_of(task, k, best.values[k]) != End::kNone;
    text += fmt::format("  {:<40} {} {}{}\n", vary.key, short_number(best.values[k]), vary.unit,
                        at_end ? "  (an end of its range)" : "");
  }
  text += fmt::format("  {:<40} {}{}\n", task.goal.figure.text, short_number(*best.figure),
                      unit_of(task.goal.figure));
  for (std::size_t k = 0; k < best.constraints.size(); ++k) {
    const Constraint& c = task.goal.constraints[k];
    text += fmt::format("  {:<40} {}{}\n", constraint_text(c), short_number(*best.constraints[k]),
                        unit_of(c.figure));
  }
  return text;
}

}  // namespace rotorub::optimise
