#include "compare/bench/output.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/base/units.h"
#include "compare/bench/work_precision.h"
#include "compare/figures/figure.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"

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
              {"clearance", bench.clearance()},
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

constexpr int kEngine = 20;  // for "mujoco-cone-coulomb"

std::string level_line(const Level& level, const std::vector<Point>& points) {
  std::string line = fmt::format("  {:<7.0e}", level.share);
  if (level.engines.empty()) return line + "no engine reaches it\n";
  const Best& first = level.engines.front();
  line += fmt::format("{:<{}}{:<24}{:>10.4g} ms ", first.engine, kEngine,
                      setting_text(points[first.point].setting), 1e3 * first.seconds);
  for (std::size_t k = 1; k < level.engines.size(); ++k) {
    const Best& other = level.engines[k];
    line += fmt::format("{} {} ×{:.3g}", k > 1 ? "," : " ", other.engine,
                        other.seconds / first.seconds);
  }
  if (level.engines.size() == 1) line += "  alone";
  if (!level.judged) line += "  (at the reference's own error)";
  return line + "\n";
}

std::string series_lines(const SceneBench& bench) {
  std::string text = fmt::format("\n  {:<38}{:>6}{:>10}{:>12}  {}\n", "engine and setting", "order",
                                 "us/step", "least error", "outcomes");
  for (const Series& s : series_of(bench.points, bench.telling_errors())) {
    const auto optional = [](bool there, const std::string& value) { return there ? value : "–"; };
    const double least = s.best ? bench.points[*s.best].errors->position : 0.0;
    text +=
        fmt::format("  {:<{}}{:<18}{:>6}{:>10}{:>12}  {}\n", s.engine, kEngine, s.setting,
                    optional(s.order.has_value(), fmt::format("{:.2f}", s.order.value_or(0.0))),
                    optional(s.us_per_step > 0.0, fmt::format("{:.3g}", s.us_per_step)),
                    optional(s.best.has_value(), fmt::format("{:.1e} m", least)), outcomes_text(s));
    if (!s.reason.empty()) text += wrapped("      ", s.reason);
  }
  return text;
}

}  // namespace

json point_json(const Point& p) {
  const auto error = [&](auto member) {
    return p.errors ? number_or_null(*p.errors.*member) : json(nullptr);
  };
  const auto metric = [&](double Metrics::*member) {
    return p.metrics ? number_or_null(*p.metrics.*member) : json(nullptr);
  };
  const auto cost = [&](double value) {
    return p.wall.repeats > 0 ? number_or_null(value) : json(nullptr);
  };
  return {{"engine", p.setting.engine},
          {"setting", p.setting.setting},
          {"step", number_or_null(p.setting.step)},
          {"outcome", to_string(p.judgement.outcome)},
          {"reason", p.judgement.reason},
          {"position_error", error(&PointErrors::position)},
          {"force_error", error(&PointErrors::force)},
          {"impulse_error", error(&PointErrors::impulse)},
          {"limit_error", number_or_null(p.limit_error)},
          {"penetration", metric(&Metrics::max_penetration)},
          {"predicted_penetration", metric(&Metrics::whirl_penetration)},
          {"energy_residual", metric(&Metrics::energy_residual)},
          {"residuals", p.metrics ? residuals_json(p.metrics->residuals) : json(nullptr)},
          {"settled", p.metrics ? settled_json(p.metrics->settled) : json(nullptr)},
          {"steps", p.steps},
          {"us_per_step", cost(p.us_per_step())},
          {"real_time_factor", cost(p.real_time_factor())},
          {"wall_ms", wall_json(p.wall)}};
}

json bench_json(const Machine& machine, const std::vector<SceneBench>& benches,
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

std::string bench_table(const SceneBench& bench) {
  const std::string head = fmt::format(
      "{:.4g} s; errors against {} (its own: {:.1e} m), levels as shares of the clearance {:.3g} "
      "mm",
      bench.scene.run.end, bench.reference.source, bench.reference.error, 1e3 * bench.clearance());
  std::string text = wrapped(scene::printable(bench.scene.name) + ": ", head, 2) +
                     fmt::format("\n  {:<7}{:<{}}{:<24}{:>13}   {}\n", "level", "fastest", kEngine,
                                 "setting", "median", "others");
  for (const Level& level : bench.levels) {
    if (in_headline(level)) text += level_line(level, bench.points);
  }
  return text + "\n" + wrapped("  ", verdict_text(bench.levels)) + series_lines(bench);
}

std::string missing_text() {
  std::string text;
  for (const BenchEngine& engine : bench_engines()) {
    if (!engine.missing.empty()) {
      text += fmt::format("{} is left out: {}\n", engine.name, engine.missing);
    }
  }
  return text;
}

}  // namespace rotorub::bench
