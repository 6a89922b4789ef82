#include "compare/optimise/output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "compare/base/columns.h"
#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/base/plot_points.h"
#include "compare/base/units.h"
#include "compare/figures/figure.h"
#include "compare/sweep/folder.h"
#include "compare/sweep/sample.h"
#include "native_model/scene/text.h"

namespace rotorub::optimise {
namespace {

using result::Data, result::Section, result::Sentence, result::Table;

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

// "<= 150"
std::string limit_text(const Constraint& c) {
  return fmt::format("{} {}", c.is_max ? "<=" : ">=", short_number(c.limit));
}

std::string ending_text(const Optimum& optimum) {
  const std::size_t count = optimum.evaluations.size();
  if (optimum.ending == Ending::kEvaluations)
    return fmt::format("stopped at the limit of {} evaluations", count);
  return fmt::format("{} evaluations, {}", count, to_string(optimum.ending));
}

std::string nothing_text(const Optimum& optimum) {
  const Evaluation* nearest = nullptr;
  for (const Evaluation& e : optimum.evaluations) {
    if (e.ok() && (!nearest || e.violation < nearest->violation)) nearest = &e;
  }
  if (!nearest) {
    const bool any = !optimum.evaluations.empty();
    return "  none of them could be run" + (any ? ": " + optimum.evaluations.back().reason : "");
  }
  return fmt::format(
      "  none of them meets the constraints; the nearest, evaluation {}, violates one by "
      "{:.3g} % of its limit",
      nearest - optimum.evaluations.data(), 100.0 * nearest->violation);
}

Section best_of(const Task& task, const Optimum& optimum) {
  const Goal& goal = task.goal;
  const Evaluation& best = optimum.evaluations[*optimum.best];
  constexpr int kNames = -42;
  const auto item = [](double value, const std::string& unit) -> result::Item {
    return {value, fmt::format(" {}{}{}", short_number(value), unit.empty() ? "" : " ", unit)};
  };
  std::vector<std::string> places;
  Table values{"values/{row}", {{.width = kNames}, {.key = "number"}}};
  for (std::size_t k = 0; k < best.values.size(); ++k) {
    const sweep::Vary& vary = task.study.vary[k];
    const bool at_end = end_of(task, k, best.values[k]) != End::kNone;
    places.push_back(key_in_words(vary.key) + " " + usual_text(best.values[k], vary.unit));
    values.rows.push_back(
        {vary.key,
         {{.text = vary.key},
          item(best.values[k],
               fmt::format("{}{}", vary.unit, at_end ? "  (an end of its range)" : ""))}});
  }
  const result::Item reached = item(*best.figure, unit_of(goal.figure));
  Table figure{"{row}",
               {{.width = kNames}, {.key = "number"}},
               {{"figure", {{.text = goal.figure.text}, reached}}}};
  Table constraints{"constraints/#/{column}",
                    {{.key = "figure", .width = kNames},
                     {.key = "max", .seen = result::kJson},
                     {.key = "min", .seen = result::kJson},
                     {.key = "value", .seen = result::kJson}}};
  for (std::size_t k = 0; k < best.constraints.size(); ++k) {
    const Constraint& c = goal.constraints[k];
    const result::Item limit{c.limit}, none;
    const std::string unit = unit_of(c.figure);
    const result::Item value = item(*best.constraints[k], unit);
    const std::string met = fmt::format("constraint met: {} ={} {}{}", c.figure.text, value.text,
                                        limit_text(c), unit.empty() ? "" : " " + unit);
    constraints.rows.push_back(
        {.items = {{c.figure.text, met}, c.is_max ? limit : none, c.is_max ? none : limit, value}});
  }
  for (Table* table : {&values, &figure, &constraints}) table->seen = result::kNotPage;
  const std::string edge = edge_text(task, optimum);
  const std::string answer = fmt::format("{}{} is {} at evaluation {}:{}, with {}.",
                                         goal.constraints.empty() ? "" : "Within the constraints, ",
                                         goal.figure.text, goal.maximise ? "largest" : "smallest",
                                         *optimum.best, reached.text, fmt::join(places, ", "));
  return {
      "best",
      {Data{"evaluation", *optimum.best},
       Sentence{.text = answer, .place = "answer", .seen = result::kNotTerminal}, values,
       Data{"edge", edge.empty() ? nlohmann::json() : nlohmann::json(edge)}, figure, constraints}};
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

std::string unit_of(const FigurePath& figure) {
  if (figure.source != Source::kRun) return {};
  const auto keys = metric_keys();
  const auto key = std::ranges::find(keys, std::string_view(figure.text), &ColumnMeaning::name);
  return key == keys.end() ? std::string() : std::string(key->unit);
}

Section result_of(const std::string& name, const Task& task, const Optimum& optimum) {
  const char* goal = task.goal.maximise ? "maximise" : "minimise";
  const std::string& figure = task.goal.figure.text;
  const std::string ending = to_string(optimum.ending), edge = edge_text(task, optimum);
  const std::size_t count = optimum.evaluations.size();
  Section all{.parts = {Data{"figure", figure}, Data{"goal", goal}, Data{"ending", ending},
                        Data{"evaluations", count},
                        Sentence{.text = fmt::format("{}: {} {}", scene::printable(name), goal,
                                                     scene::printable(figure)),
                                 .wraps = false,
                                 .seen = result::kNotPage},
                        Sentence{.text = ending_text(optimum) + (edge.empty() ? "" : ", " + edge),
                                 .lead = "  "}}};
  if (optimum.best) {
    all.add({best_of(task, optimum)});
  } else {
    all.add({Data{"best", nullptr}, result::line(nothing_text(optimum))});
  }
  return all;
}

nlohmann::json search_json(const Task& task, const Optimum& optimum) {
  const auto key = [](const sweep::Vary& vary) -> nlohmann::json {
    return {{"name", vary.key},
            {"unit", vary.unit},
            {"range", {vary.from, vary.to}},
            {"log", vary.spacing == sweep::Spacing::kLog}};
  };
  const auto constraint = [](const Constraint& c) -> nlohmann::json {
    return {{"name", c.figure.text},
            {"unit", unit_of(c.figure)},
            {"text", c.figure.text + " " + limit_text(c)}};
  };
  const auto evaluation = [](const Evaluation& e) -> nlohmann::json {
    return {{"values", e.values},
            {"figure", number_or_null(e.figure)},
            {"constraints", list_of(e.constraints, number_or_null)},
            {"feasible", e.ok() && e.violation <= Optimum::kFeasible},
            {"status", e.status}};
  };
  return {{"figure", task.goal.figure.text},
          {"unit", unit_of(task.goal.figure)},
          {"maximise", task.goal.maximise},
          {"best", optimum.best ? nlohmann::json(*optimum.best) : nlohmann::json()},
          {"keys", list_of(task.study.vary, key)},
          {"constraints", list_of(task.goal.constraints, constraint)},
          {"evaluations", list_of(optimum.evaluations, evaluation)}};
}

std::string evaluations_csv(const Task& task, const Optimum& optimum) {
  std::string text = sweep::csv_line(column_names(evaluations_columns(task)));
  for (std::size_t i = 0; i < optimum.evaluations.size(); ++i) {
    const Evaluation& e = optimum.evaluations[i];
    std::vector<std::string> line{std::to_string(i)};
    for (const double value : e.values) line.push_back(sweep::csv_number(value));
    line.push_back(sweep::csv_number(e.figure));
    for (const auto& value : e.constraints) line.push_back(sweep::csv_number(value));
    line.insert(line.end(), {sweep::csv_number(e.violation), e.status, e.reason});
    text += sweep::csv_line(line);
  }
  return text;
}

std::vector<ColumnMeaning> evaluations_columns(const Task& task) {
  std::vector<ColumnMeaning> all{
      {"evaluation", "", "number in the order of the search, from 0", ""}};
  for (const sweep::Vary& vary : task.study.vary)
    all.push_back({vary.key, vary.unit, "value of the key", ""});
  all.push_back({task.goal.figure.text, "SI", "figure that the study optimises", ""});
  for (const Constraint& c : task.goal.constraints)
    all.push_back({c.figure.text, "SI", "figure of a constraint", ""});
  all.insert(all.end(), {{"violation", "",
                          "most by which a constraint is broken, as a share of its limit", ""},
                         {"status", "", "ok, of a run, or refused", ""},
                         {"reason", "", "why it is not ok", ""}});
  return all;
}

}  // namespace rotorub::optimise
