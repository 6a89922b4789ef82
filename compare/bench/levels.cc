#include "compare/bench/levels.h"

#include <algorithm>
#include <cmath>

namespace rotorub::bench {
namespace {

constexpr double kShares[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8};

std::optional<Best> best_of(const std::vector<Point>& points, const BenchEngine& engine,
                            double error) {
  std::optional<Best> best;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Point& p = points[k];
    if (p.setting.engine != engine.name || !p.finished() || p.wall.repeats == 0) continue;
    if (p.errors->position > error) continue;
    if (!best || p.wall.median < best->seconds) {
      best = Best{engine.name, engine.family, k, p.wall.median};
    }
  }
  return best;
}

}  // namespace

std::vector<Level> levels(const std::vector<Point>& points, const std::vector<BenchEngine>& engines,
                          double clearance, double reference_error) {
  std::vector<Level> all;
  for (const double share : kShares) {
    Level level;
    level.share = share;
    level.error = share * clearance;
    level.judged = level.error >= kReferenceMargin * reference_error;
    for (const BenchEngine& engine : engines) {
      if (const auto best = best_of(points, engine, level.error)) level.engines.push_back(*best);
    }
    std::stable_sort(level.engines.begin(), level.engines.end(),
                     [](const Best& a, const Best& b) { return a.seconds < b.seconds; });
    all.push_back(std::move(level));
  }
  return all;
}

std::optional<bool> native_is_fastest(const Level& level) {
  if (level.engines.empty()) return {};
  return level.engines.front().family == Family::kNative;
}

std::optional<bool> rigid_is_fastest_mujoco(const Level& level) {
  for (const Best& best : level.engines) {
    if (best.family == Family::kMujoco) return best.engine == "mujoco-rigid";
  }
  return {};
}

std::optional<double> order_of(const std::vector<Point>& points, const std::string& engine,
                               const std::string& setting, double floor) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const Point& p : points) {
    if (p.setting.engine != engine || p.setting.setting != setting) continue;
    if (!p.setting.step || !p.finished() || p.errors->position <= floor) continue;
    const double h = std::log(*p.setting.step), e = std::log(p.errors->position);
    n += 1.0;
    x += h;
    y += e;
    xx += h * h;
    xy += h * e;
  }
  const double spread = n * xx - x * x;
  if (n < 3.0 || spread <= 0.0) return {};
  return (n * xy - x * y) / spread;
}

}  // namespace rotorub::bench
