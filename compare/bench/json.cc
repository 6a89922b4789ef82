#include "compare/bench/json.h"

#include <nlohmann/json.hpp>

#include "compare/base/json.h"
#include "compare/base/units.h"
#include "compare/bench/series.h"
#include "compare/figures/json.h"
#include "native_model/scene/reader.h"

namespace rotorub::bench {
namespace {

using nlohmann::json;

json wall_json(const WallTime& wall) {
  if (wall.repeats == 0) return nullptr;
  return {{"median", kMilli * wall.median},
          {"low", kMilli * wall.low},
          {"high", kMilli * wall.high},
          {"repeats", wall.repeats}};
}

json settled_json(const Settled& s) {
  return {{"attractor", rotorub::to_string(s.attractor)},
          {"contact_share", number_or_null(s.contact_share)},
          {"whirl_frequency", number_or_null(s.whirl_frequency)}};
}

json reference_json(const Reference& r) {
  return {{"source", r.source},
          {"error", r.error},
          {"event_distance", r.event_distance},
          {"rows", r.times.size()},
          {"settled", settled_json(settled(r.trajectory))},
          {"impulse_total", number_or_null(r.trajectory.statistics.impulse_total)}};
}

json level_json(const Level& level, const std::vector<Point>& points) {
  json engines = json::array();
  for (const Best& best : level.engines) {
    const Point& p = points[best.point];
    engines.push_back({{"engine", best.engine},
                       {"setting", p.setting.setting},
                       {"step", number_or_null(p.setting.step)},
                       {"position_error", number_or_null(p.errors->position)},
                       {"wall_ms", 1e3 * best.seconds},
                       {"ratio", best.seconds / level.engines.front().seconds}});
  }
  const auto verdict = [](std::optional<bool> v) { return v ? json(*v) : json(nullptr); };
  return {{"clearance_share", level.share},
          {"error", level.error},
          {"judged", level.judged},
          {"native_is_fastest", verdict(native_is_fastest(level))},
          {"rigid_is_fastest_mujoco", verdict(rigid_is_fastest_mujoco(level))},
          {"engines", engines}};
}

json series_json(const SceneBench& bench) {
  json all = json::array();
  for (const Series& s : series_of(bench.points, bench.telling_errors())) {
    all.push_back(
        {{"engine", s.engine}, {"setting", s.setting}, {"order", number_or_null(s.order)}});
  }
  return all;
}

json stability_json(const StabilityMap& map) {
  json cells = json::array();
  for (const StabilityCell& c : map.cells) {
    cells.push_back({{"engine", c.engine},
                     {"friction", c.friction},
                     {"step", c.step},
                     {"stiffness", c.stiffness > 0.0 ? json(c.stiffness) : json(nullptr)},
                     {"outcome", to_string(c.judgement.outcome)},
                     {"reason", c.judgement.reason}});
  }
  return {{"engines", map.engines},
          {"steps", map.steps},
          {"stiffnesses", map.stiffnesses},
          {"frictions", map.frictions},
          {"cells", cells}};
}

json restitution_json(const std::vector<RestitutionRow>& rows) {
  json all = json::array();
  for (const RestitutionRow& r : rows) {
    all.push_back({{"asked", r.asked},
                   {"engine", r.engine},
                   {"setting", r.setting},
                   {"got", r.failure.empty() ? number_or_null(r.got) : json(nullptr)},
                   {"reason", r.failure}});
  }
  return all;
}

json scene_json(const SceneBench& bench) {
  json points = json::array(), levels = json::array(), engines = json::array();
  for (const Point& p : bench.points) points.push_back(point_json(p));
  for (const Level& level : bench.levels) levels.push_back(level_json(level, bench.points));
  for (const BenchEngine& e : bench.engines) {
    engines.push_back({{"engine", e.name}, {"family", to_string(e.family)}, {"what", e.what}});
  }
  json missing = json::array();
  for (const BenchEngine& e : bench_engines()) {
    if (!e.missing.empty()) missing.push_back({{"engine", e.name}, {"reason", e.missing}});
  }
  json all = {{"scene", bench.scene.name},
              {"scene_hash", scene::scene_hash(bench.scene)},
              {"clearance", bench.scene.first().contact->clearance},
              {"reference", reference_json(bench.reference)},
              {"engines", engines},
              {"missing_engines", missing},
              {"points", points},
              {"series", series_json(bench)},
              {"levels", levels},
              {"interrupted", bench.interrupted}};
  if (bench.stability) all["stability"] = stability_json(*bench.stability);
  return all;
}

}  // namespace

nlohmann::json point_json(const Point& p) {
  json j = {{"engine", p.setting.engine},
            {"setting", p.setting.setting},
            {"step", number_or_null(p.setting.step)},
            {"outcome", to_string(p.judgement.outcome)},
            {"reason", p.judgement.reason},
            {"position_error", nullptr},
            {"force_error", nullptr},
            {"impulse_error", nullptr},
            {"limit_error", number_or_null(p.limit_error)},
            {"penetration", nullptr},
            {"predicted_penetration", nullptr},
            {"energy_residual", nullptr},
            {"residuals", nullptr},
            {"settled", nullptr},
            {"steps", p.steps},
            {"us_per_step", nullptr},
            {"real_time_factor", nullptr},
            {"wall_ms", wall_json(p.wall)}};
  if (p.errors) {
    j["position_error"] = number_or_null(p.errors->position);
    j["force_error"] = number_or_null(p.errors->force);
    j["impulse_error"] = number_or_null(p.errors->impulse);
  }
  if (p.metrics) {
    const json figures = metrics_json(*p.metrics);
    j["penetration"] = number_or_null(p.metrics->max_penetration);
    j["predicted_penetration"] = number_or_null(p.metrics->whirl_penetration);
    j["energy_residual"] = number_or_null(p.metrics->energy_residual);
    j["residuals"] = figures.contains("residuals") ? figures["residuals"] : json(nullptr);
    j["settled"] = settled_json(p.metrics->settled);
  }
  if (p.wall.repeats > 0) {
    j["us_per_step"] = number_or_null(p.us_per_step());
    j["real_time_factor"] = number_or_null(p.real_time_factor());
  }
  return j;
}

nlohmann::json bench_json(const Machine& machine, const std::vector<SceneBench>& benches,
                          const std::vector<RestitutionRow>& restitution) {
  json scenes = json::array();
  for (const SceneBench& bench : benches) scenes.push_back(scene_json(bench));
  json all = {{"machine",
               {{"processor", machine.processor},
                {"threads", machine.threads},
                {"instructions", machine.instructions},
                {"compiler", machine.compiler},
                {"mujoco_version", machine.mujoco}}},
              {"scenes", scenes}};
  if (!restitution.empty()) all["restitution"] = restitution_json(restitution);
  return all;
}

}  // namespace rotorub::bench
