#include "compare/report/optimum_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "compare/base/units.h"
#include "compare/optimise/output.h"
#include "compare/report/page_frame.h"
#include "compare/report/plot_points.h"
#include "compare/result/result.h"

namespace rotorub {
namespace {

using nlohmann::json;
using optimise::Constraint;
using optimise::Evaluation;
using optimise::Optimum;
using optimise::Task;

// The evaluated scenes in their order, for page/optimum.js.
json search_json(const Task& task, const Optimum& optimum) {
  const auto of_each = [&](const auto& value) {
    return list_of(optimum.evaluations, [&](const Evaluation& e) -> json {
      const std::optional<double> x = value(e);
      return x ? json(rounded(*x)) : json();
    });
  };
  json keys = json::array(), values = json::array(), constraints = json::array();
  for (std::size_t k = 0; k < task.study.vary.size(); ++k) {
    const sweep::Vary& vary = task.study.vary[k];
    const ShownUnit unit = shown_unit(vary.unit);
    keys.push_back({{"name", vary.key},
                    {"unit", unit.name},
                    {"range", {rounded(unit.per_si * vary.from), rounded(unit.per_si * vary.to)}},
                    {"log", vary.spacing == sweep::Spacing::kLog}});
    values.push_back(of_each([&](const Evaluation& e) { return unit.per_si * e.values[k]; }));
  }
  for (std::size_t k = 0; k < task.goal.constraints.size(); ++k) {
    const Constraint& c = task.goal.constraints[k];
    constraints.push_back(
        {{"name", c.figure.text},
         {"unit", optimise::unit_of(c.figure)},
         {"text", optimise::constraint_text(c)},
         {"values", of_each([&](const Evaluation& e) { return e.constraints[k]; })}});
  }
  return {{"figure", task.goal.figure.text},
          {"unit", optimise::unit_of(task.goal.figure)},
          {"maximise", task.goal.maximise},
          {"best", optimum.best ? json(*optimum.best) : json()},
          {"keys", keys},
          {"values", values},
          {"column", of_each([](const Evaluation& e) { return e.figure; })},
          {"constraints", constraints},
          {"feasible", list_of(optimum.evaluations,
                               [](const Evaluation& e) {
                                 return e.ok() && e.violation <= Optimum::kFeasible;
                               })},
          {"status", list_of(optimum.evaluations, [](const Evaluation& e) { return e.status; })}};
}

}  // namespace

std::string optimum_page(const std::string& name, const Task& task, const Optimum& optimum,
                         const std::string& best) {
  std::vector<std::string> keys;
  for (const sweep::Vary& vary : task.study.vary) keys.push_back(vary.key);
  return laid_out_page(
      {name, "optimise",
       fmt::format("Which values of {} {} {}?", fmt::join(keys, " and "),
                   task.goal.maximise ? "maximise" : "minimise", task.goal.figure.text)},
      optimise::result_of(name, task, optimum), "optimise",
      {{"search", search_json(task, optimum)}, {"texts", {best}}},
      "`rotorub optimise --json` prints the figures in SI units.");
}

}  // namespace rotorub
