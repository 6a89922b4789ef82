#include "compare/report/command_pages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "compare/base/json.h"
#include "compare/bench/output.h"
#include "compare/modes/result.h"
#include "compare/modes/rub_branches_text.h"
#include "compare/modes/rub_map_text.h"
#include "compare/optimise/output.h"
#include "compare/report/linear_maps.h"
#include "compare/report/page_frame.h"
#include "compare/report/plot_points.h"
#include "compare/result/result.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

using nlohmann::json;
using optimise::Constraint;
using optimise::Evaluation;
using optimise::Optimum;
using optimise::Task;

std::string si_footer(const char* command) {
  return fmt::format("rotorub {} --json prints the figures in SI units.", command);
}

// The goal of a search and its evaluations in their order, SI.
json search_json(const Task& task, const Optimum& optimum) {
  const auto key = [](const sweep::Vary& vary) -> json {
    return {{"name", vary.key},
            {"unit", vary.unit},
            {"range", {vary.from, vary.to}},
            {"log", vary.spacing == sweep::Spacing::kLog}};
  };
  const auto constraint = [](const Constraint& c) -> json {
    return {{"name", c.figure.text},
            {"unit", optimise::unit_of(c.figure)},
            {"text", optimise::constraint_text(c)}};
  };
  const auto evaluation = [](const Evaluation& e) -> json {
    return {{"values", e.values},
            {"figure", number_or_null(e.figure)},
            {"constraints", list_of(e.constraints, number_or_null)},
            {"feasible", e.ok() && e.violation <= Optimum::kFeasible},
            {"status", e.status}};
  };
  return {{"figure", task.goal.figure.text},
          {"unit", optimise::unit_of(task.goal.figure)},
          {"maximise", task.goal.maximise},
          {"best", optimum.best ? json(*optimum.best) : json()},
          {"keys", list_of(task.study.vary, key)},
          {"constraints", list_of(task.goal.constraints, constraint)},
          {"evaluations", list_of(optimum.evaluations, evaluation)}};
}

}  // namespace

std::string bench_page(const bench::Machine& machine, const std::vector<bench::SceneBench>& benches,
                       const std::vector<bench::RestitutionRow>& restitution) {
  const result::Section found = bench::result_of(machine, benches, restitution);
  const json all = json_of(found);
  std::vector<std::string> names, texts;
  for (const bench::SceneBench& bench : benches) {
    names.push_back(bench.scene.name);
    texts.push_back(bench.scene.text);
  }
  return laid_out_page(
      {fmt::format("{}", fmt::join(names, ", ")), "speed against error",
       "Which solver is the fastest for a given error?"},
      found, "bench",
      {{"benches", all.at("scenes")}, {"machine", all.at("machine")}, {"texts", texts}},
      "Peers get the contact of a disc in a ring (its normal from the present positions) from us; "
      "the solver is theirs. Native times include the bookkeeping of energy and contact; those of "
      "MuJoCo and of the peers do not.");
}

std::string modes_page(const scene::Scene& scene, const Campbell& campbell) {
  json rotor = rotor_data(scene, campbell);
  rotor["stiffness"] = stiffness_data(scene);
  const bool is_sheared =
      scene.rotor.geometry && scene.rotor.geometry->theory == scene::ShaftTheory::kTimoshenko;
  return laid_out_page(
      {scene.name, "whirl of the free rotor",
       "Where does it whirl, and where does it stay stable?"},
      modes_result(scene.name, campbell.analysis), "modes",
      {{"rotor", std::move(rotor)},
       {"loops", loop_data(campbell.analysis)},
       {"texts", {scene.text}}},
      fmt::format("Scene {}. Limits: {} shaft with rotary inertia, small deflections, no contact.",
                  scene::scene_hash(scene), is_sheared ? "Timoshenko" : "Euler-Bernoulli"));
}

std::string rub_map_page(const scene::Scene& scene, const RubKeyMap& map) {
  return laid_out_page({scene.name, "lasting rubs", "Which rubs last, and where?"},
                       rub_map_picture(scene.name, map), "rub_map",
                       {{"rub_map",
                         {{"across", axis_json(map.across)},
                          {"up", axis_json(map.up)},
                          {"columns", rub_columns(map.points)}}},
                        {"texts", {scene.text}}},
                       si_footer("modes --rub-map"));
}

std::string feedback_map_page(const scene::Scene& scene, const rub::FeedbackMap& map) {
  return laid_out_page({scene.name, "cross-coupled feedback", "Which feedback calms the rub?"},
                       feedback_map_table(scene.name, map), "feedback_map",
                       {{"feedback_map", feedback_map_json(map)}, {"texts", {scene.text}}},
                       si_footer("modes --feedback-map"));
}

std::string branches_page(const scene::Scene& scene, const RubBranches& all) {
  const result::Section found = rub_branches_result(scene.name, all);
  return laid_out_page({scene.name, "periodic rubs", "Which rubs repeat, and which of them last?"},
                       found, "branches",
                       {{"branches", json_of(found).at("rub_branches")}, {"texts", {scene.text}}},
                       si_footer("modes --periodic --across"));
}

std::string optimum_page(const std::string& name, const Task& task, const Optimum& optimum,
                         const std::string& best) {
  std::vector<std::string> keys;
  for (const sweep::Vary& vary : task.study.vary) keys.push_back(vary.key);
  return laid_out_page(
      {name, "optimise",
       fmt::format("Which values of {} {} {}?", fmt::join(keys, " and "),
                   task.goal.maximise ? "maximise" : "minimise", task.goal.figure.text)},
      optimise::result_of(name, task, optimum), "optimise",
      {{"search", search_json(task, optimum)}, {"texts", {best}}}, si_footer("optimise"));
}

}  // namespace rotorub
