#include "compare/bench/levels.h"

#include <fmt/format.h>

#include <algorithm>

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

bool in_headline(const Level& level) { return level.share > 0.5 * kHeadlineShare; }

std::string verdict_text(const std::vector<Level>& levels) {
  std::string native, rigid;
  for (const Level& level : levels) {
    if (!in_headline(level)) continue;
    const auto note = [&](std::optional<bool> verdict, std::string& text) {
      if (verdict && !*verdict) text += fmt::format(" {:.0e}", level.share);
    };
    note(native_is_fastest(level), native);
    note(rigid_is_fastest_mujoco(level), rigid);
  }
  return fmt::format("a native integrator is the fastest {}; rigid of MuJoCo's settings {}",
                     native.empty() ? "at every level reached" : "but not at" + native,
                     rigid.empty() ? "at every level that MuJoCo reaches" : "but not at" + rigid);
}

}  // namespace rotorub::bench
