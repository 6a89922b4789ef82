#include "compare/bench/table.h"

#include <fmt/format.h>

#include "compare/bench/series.h"

namespace rotorub::bench {
namespace {

std::string level_line(const Level& level, const std::vector<Point>& points) {
  std::string line = fmt::format("  {:<7.0e}", level.share);
  if (level.engines.empty()) return line + "no engine reaches it\n";
  const Best& first = level.engines.front();
  line += fmt::format("{:<17} {:<24}{:>10.4g} ms ", first.engine,
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
  std::string text = fmt::format("\n  {:<37}{:>6}{:>10}{:>12}  {}\n", "engine and setting", "order",
                                 "us/step", "least error", "outcomes");
  for (const Series& s : series_of(bench.points, bench.telling_errors())) {
    const auto optional = [](bool there, const std::string& value) { return there ? value : "–"; };
    const double least = s.best ? bench.points[*s.best].errors->position : 0.0;
    text +=
        fmt::format("  {:<17}{:<20}{:>6}{:>10}{:>12}  {}\n", s.engine, " " + s.setting,
                    optional(s.order.has_value(), fmt::format("{:.2f}", s.order.value_or(0.0))),
                    optional(s.us_per_step > 0.0, fmt::format("{:.3g}", s.us_per_step)),
                    optional(s.best.has_value(), fmt::format("{:.1e} m", least)), outcomes_text(s));
    if (!s.reason.empty()) text += fmt::format("      {}\n", s.reason);
  }
  return text;
}

}  // namespace

std::string bench_table(const SceneBench& bench) {
  const double clearance = bench.scene.first().contact->clearance;
  std::string text = fmt::format(
      "{}: {:.4g} s; errors against {} (its own: {:.1e} m), levels as shares of the clearance "
      "{:.3g} "
      "mm\n\n  {:<7}{:<17} {:<24}{:>13}   {}\n",
      bench.scene.name, bench.scene.run.end, bench.reference.source, bench.reference.error,
      1e3 * clearance, "level", "fastest", "setting", "median", "others");
  for (const Level& level : bench.levels) {
    if (in_headline(level)) text += level_line(level, bench.points);
  }
  return text + "\n  " + verdict_text(bench.levels) + "\n" + series_lines(bench);
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
