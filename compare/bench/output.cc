#include "compare/bench/output.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "compare/base/json.h"
#include "compare/base/units.h"
#include "compare/bench/work_precision.h"
#include "compare/figures/figure.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"

namespace rotorub::bench {
namespace {

using nlohmann::json;
using result::Data;
using result::Section;
using result::Sentence;

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

result::Table series_table(const SceneBench& bench) {
  result::Table table{"series/#/{column}",
                      {{"engine", "engine and setting", -kEngine - 2},
                       {"setting", "", -18},
                       {"order", "order", 6},
                       {.heading = "us/step", .width = 10},
                       {.heading = "least error", .width = 12},
                       {.heading = "  outcomes"}}};
  for (const Series& s : series_of(bench.points, bench.telling_errors())) {
    const std::string cost = s.us_per_step > 0.0 ? fmt::format("{:.3g}", s.us_per_step) : "–";
    const std::string least =
        s.best ? fmt::format("{:.1e} m", bench.points[*s.best].errors->position) : "–";
    table.rows.push_back(
        {.items = {{s.engine},
                   {s.setting},
                   {number_or_null(s.order), s.order ? fmt::format("{:.2f}", *s.order) : "–"},
                   {.text = cost},
                   {.text = least},
                   {.text = "  " + outcomes_text(s)}},
         .note = {.text = s.reason, .lead = "      "}});
  }
  return table;
}

}  // namespace

Section scene_section(const SceneBench& bench) {
  json points = json::array(), engines = json::array(), missing = json::array();
  for (const Point& p : bench.points) points.push_back(point_json(p));
  for (const BenchEngine& e : bench.engines) {
    engines.push_back({{"engine", e.name}, {"family", to_string(e.family)}, {"what", e.what}});
  }
  for (const BenchEngine& e : bench_engines()) {
    if (!e.missing.empty()) missing.push_back({{"engine", e.name}, {"reason", e.missing}});
  }
  const std::string head = fmt::format(
      "{:.4g} s; errors against {} (its own: {:.1e} m), levels as shares of the clearance {:.3g} "
      "mm",
      bench.scene.run.end, bench.reference.source, bench.reference.error,
      kMilli * bench.clearance());
  Section section{
      "scenes/#",
      {Data{"",
            {{"scene", bench.scene.name},
             {"scene_hash", scene::scene_hash(bench.scene)},
             {"clearance", bench.clearance()},
             {"reference", reference_json(bench.reference)},
             {"engines", engines},
             {"missing_engines", missing},
             {"points", points},
             {"interrupted", bench.interrupted}}},
       Sentence{.text = head, .lead = scene::printable(bench.scene.name) + ": ", .indent = 2},
       result::line(fmt::format("\n  {:<7}{:<{}}{:<24}{:>13}   {}", "level", "fastest", kEngine,
                                "setting", "median", "others"))}};
  for (const Level& level : bench.levels) {
    section.add({Data{"levels/#", level_json(level, bench.points)}});
    if (in_headline(level)) section.add({result::line(level_line(level, bench.points))});
  }
  section.add({Sentence{}, Sentence{.text = verdict_text(bench.levels), .lead = "  "}, Sentence{},
               series_table(bench)});
  if (bench.stability) section.add({Data{"stability", stability_json(*bench.stability)}});
  return section;
}

Section result_of(const Machine& machine, const std::vector<SceneBench>& benches,
                  const std::vector<RestitutionRow>& restitution) {
  Section result{.parts = {Data{"machine",
                                {{"processor", machine.processor},
                                 {"threads", machine.threads},
                                 {"instructions", machine.instructions},
                                 {"compiler", machine.compiler},
                                 {"mujoco_version", machine.mujoco}}},
                           Data{"scenes", json::array()}}};
  for (const SceneBench& bench : benches) result.add({scene_section(bench)});
  if (!restitution.empty()) result.add({Data{"restitution", restitution_json(restitution)}});
  return result;
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
