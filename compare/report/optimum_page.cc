#include "compare/report/optimum_page.h"

#include <nlohmann/json.hpp>

#include "compare/base/units.h"
#include "compare/optimise/output.h"
#include "compare/report/linear_maps.h"
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

json figure_of(const std::string& name, const std::string& meaning) {
  return {{"name", name}, {"unit", ""}, {"meaning", meaning}, {"word", false}};
}

// Each evaluation is a mark, like the points of a sweep.
json plots_of(const Task& task, const Optimum& optimum) {
  json keys = json::array(), values = json::array(), columns = json::array();
  json status = json::array(), statuses = {"ok", "failed"};
  const auto& all = optimum.evaluations;
  for (std::size_t k = 0; k < task.study.vary.size(); ++k) {
    const sweep::Vary& vary = task.study.vary[k];
    const ShownUnit unit = shown_unit(vary.unit);
    keys.push_back({{"name", vary.key},
                    {"unit", unit.name},
                    {"even", false},
                    {"log", vary.spacing == sweep::Spacing::kLog}});
    values.push_back(list_of(
        all, [&](const Evaluation& e) { return json(rounded(unit.per_si * e.values[k])); }));
  }
  const auto shown = [](const std::optional<double>& x) {
    return x ? json(rounded(*x)) : json(nullptr);
  };
  columns.push_back(list_of(all, [&](const Evaluation& e) { return shown(e.figure); }));
  json figures = {figure_of(task.goal.figure.text, "what is optimised, SI")};
  for (std::size_t k = 0; k < task.goal.constraints.size(); ++k) {
    const Constraint& c = task.goal.constraints[k];
    figures.push_back(figure_of(c.figure.text, "kept: " + optimise::constraint_text(c) + ", SI"));
    columns.push_back(list_of(all, [&](const Evaluation& e) { return shown(e.constraints[k]); }));
  }
  figures.push_back(figure_of("evaluation", "in the order of the search, from 0"));
  json order = json::array();
  for (std::size_t i = 0; i < all.size(); ++i) {
    order.push_back(i);
    status.push_back(all[i].ok() ? 0 : 1);
  }
  columns.push_back(order);
  return {{"kind", "marks"},    {"keys", keys},     {"figures", figures},   {"values", values},
          {"columns", columns}, {"status", status}, {"statuses", statuses}, {"every", 1}};
}

}  // namespace

std::string optimum_page(const std::string& name, const Task& task, const Optimum& optimum,
                         const std::string& best) {
  const result::Section found = optimise::result_of(name, task, optimum);
  json above = page_json(found);
  above.push_back({{"lead", "Each mark is a scene that was tried."}});
  const std::string second =
      task.goal.constraints.empty() ? "evaluation" : task.goal.constraints.front().figure.text;
  return map_page({.head = {name, "optimise", "Which values are best?"},
                   .command = "optimise",
                   .first = {task.goal.figure.text, second},
                   .above = above,
                   .below = json::array(),
                   .scene = best},
                  found, plots_of(task, optimum));
}

}  // namespace rotorub
