#include "compare/bench/table.h"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "compare/study/format.h"

namespace rotorub::bench {
namespace {

// "10 us", "tolerance 1e-8", "RK4, 10 us".
std::string setting_text(const Setting& s) {
  if (!s.step) return s.setting;
  const std::string step = time_text(*s.step);
  return s.setting.empty() ? step : s.setting + ", " + step;
}

std::string level_line(const Level& level, const std::vector<Point>& points) {
  std::string line = fmt::format("  {:<7.0e}", level.share);
  if (level.engines.empty()) return line + "no engine reaches it\n";
  const Best& first = level.engines.front();
  line += fmt::format("{:<17} {:<24}{:>10.4g} ms ", first.engine,
                      setting_text(points[first.point].setting), 1e3 * first.seconds);
  for (std::size_t k = 1; k < level.engines.size(); ++k) {
    const Best& other = level.engines[k];
    line += fmt::format("{} {} ×{:.3g}", k > 1 ? "," : " ", other.engine, other.seconds / first.seconds);
  }
  if (level.engines.size() == 1) line += "  alone";
  if (!level.judged) line += "  (at the reference's own error)";
  return line + "\n";
}

// What is said of one engine and setting.
struct Series {
  double least = -1.0;   // m, its most exact point
  std::string least_at;
  double us = 0.0;       // of its finest point
  std::map<Outcome, int> outcomes;
  std::string reason;  // of its first failure
};

std::string series_lines(const SceneBench& bench) {
  std::vector<std::pair<std::string, std::string>> order;
  std::map<std::pair<std::string, std::string>, Series> all;
  for (const Point& p : bench.points) {
    // Tolerances are settings of one series.
    const std::pair<std::string, std::string> key{p.setting.engine,
                                                  p.setting.step ? p.setting.setting : ""};
    if (!all.contains(key)) order.push_back(key);
    Series& s = all[key];
    ++s.outcomes[p.judgement.outcome];
    if (p.judgement.outcome != Outcome::kOk && s.reason.empty()) s.reason = p.judgement.reason;
    if (!p.finished()) continue;
    if (s.least < 0.0 || p.errors->position < s.least) {
      s.least = p.errors->position;
      s.least_at = setting_text(p.setting);
    }
    if (p.wall.repeats > 0) s.us = p.us_per_step();
  }
  std::string text = fmt::format("\n  {:<37}{:>6}{:>10}{:>12}  {}\n", "engine and setting", "order",
                                 "us/step", "least error", "outcomes");
  for (const auto& key : order) {
    const Series& s = all[key];
    const auto slope = order_of(bench.points, key.first, key.second,
                                kReferenceMargin * bench.reference.error);
    std::string line = fmt::format("  {:<17} {:<19}", key.first, key.second);
    line += slope ? fmt::format("{:>6.2f}", *slope) : fmt::format("{:>6}", "–");
    line += s.us > 0.0 ? fmt::format("{:>10.3g}", s.us) : fmt::format("{:>10}", "–");
    line += s.least >= 0.0 ? fmt::format("{:>10.1e} m", s.least) : fmt::format("{:>12}", "–");
    std::string counts;
    for (const auto& [outcome, count] : s.outcomes) {
      counts += fmt::format("{}{} {}", counts.empty() ? "  " : ", ", count, to_string(outcome));
    }
    text += line + counts + "\n";
    if (!s.reason.empty()) text += fmt::format("      {}\n", s.reason);
  }
  return text;
}

std::string verdict_line(const SceneBench& bench) {
  std::string native, rigid;
  for (const Level& level : bench.levels) {
    const auto note = [&](std::optional<bool> verdict, std::string& text) {
      if (verdict && !*verdict) text += fmt::format(" {:.0e}", level.share);
    };
    note(native_is_fastest(level), native);
    note(rigid_is_fastest_mujoco(level), rigid);
  }
  return fmt::format("\n  a native integrator is the fastest {}; `rigid` of MuJoCo's settings {}\n",
                     native.empty() ? "at every level reached" : "but not at" + native,
                     rigid.empty() ? "at every level it reaches" : "but not at" + rigid);
}

}  // namespace

std::string bench_table(const SceneBench& bench) {
  const double clearance = bench.scene.contact->clearance;
  std::string text = fmt::format(
      "{}: {:.4g} s; errors against {} (its own: {:.1e} m), levels as shares of the clearance {:.3g} "
      "mm\n\n  {:<7}{:<17} {:<24}{:>13}   {}\n",
      bench.scene.name, bench.scene.run.end, bench.reference.source, bench.reference.error,
      1e3 * clearance, "level", "fastest", "setting", "median", "others");
  for (const Level& level : bench.levels) text += level_line(level, bench.points);
  return text + verdict_line(bench) + series_lines(bench);
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
