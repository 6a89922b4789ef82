#include "compare/report/optimum_page.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "compare/base/format.h"
#include "compare/optimise/output.h"
#include "compare/report/assets.h"
#include "compare/report/linear_maps.h"
#include "compare/report/page_frame.h"
#include "compare/report/plot_points.h"
#include "compare/report/sweep_page.h"

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

json cards_of(const Task& task, const Optimum& optimum) {
  const std::string edge = optimise::edge_text(task, optimum);
  const std::string count = fmt::format("{} evaluations{}{}", optimum.evaluations.size(),
                                        edge.empty() ? "" : "; the best is ", edge);
  json cards = {card("Search", optimum.best ? "good" : "bad", to_string(optimum.ending), count)};
  if (!optimum.best) return cards;
  const Evaluation& best = optimum.evaluations[*optimum.best];
  cards.push_back(card(task.goal.maximise ? "Largest" : "Least", "", short_number(*best.figure),
                       fmt::format("{}, SI; evaluation {}", task.goal.figure.text, *optimum.best)));
  for (std::size_t k = 0; k < best.values.size(); ++k) {
    const sweep::Vary& vary = task.study.vary[k];
    const ShownUnit unit = shown_unit(vary.unit);
    cards.push_back(card(
        vary.key, "", fmt::format("{} {}", short_number(unit.per_si * best.values[k]), unit.name),
        fmt::format("of {} to {}", short_number(unit.per_si * vary.from),
                    short_number(unit.per_si * vary.to))));
  }
  return cards;
}

}  // namespace

std::string optimum_page(const std::string& name, const Task& task, const Optimum& optimum,
                         const std::string& best) {
  const json plots = plots_of(task, optimum);
  json values = page_frame({name, "optimise", "Which values are best?"}, {{"maps", {plots}}});
  std::string lead =
      fmt::format("{} {}", task.goal.maximise ? "Maximised:" : "Minimised:", task.goal.figure.text);
  for (const Constraint& c : task.goal.constraints)
    lead += fmt::format(", with {}", optimise::constraint_text(c));
  values["lead"] = lead + ". Each mark is a scene that was tried.";
  values["command"] = "optimise";
  const std::string second =
      task.goal.constraints.empty() ? "evaluation" : task.goal.constraints.front().figure.text;
  values["maps"] = figure_choices({task.goal.figure.text, second});
  values["cards"] = cards_of(task, optimum);
  values["figures"] = plots.at("figures");
  values["rule"] = nullptr;
  values["text"] = best.empty() ? "none that runs and keeps the constraints" : best;
  return fill_page(map_page_html(), values);
}

}  // namespace rotorub
