#include "compare/bench/work_precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "compare/base/format.h"

namespace rotorub::bench {
namespace {

std::string series_setting(const Setting& s) { return s.step ? s.setting : ""; }

void take(const std::vector<Point>& points, std::size_t index, Series& series) {
  const Point& p = points[index];
  series.points.push_back(index);
  ++series.outcomes[p.judgement.outcome];
  if (p.judgement.outcome != Outcome::kOk && series.reason.empty()) {
    series.reason = p.judgement.reason;
  }
  if (p.wall.repeats > 0) series.us_per_step = p.us_per_step();
  if (!p.finished()) return;
  if (!series.best || p.errors->position < points[*series.best].errors->position) {
    series.best = index;
  }
}

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

std::vector<Series> series_of(const std::vector<Point>& points, const ErrorRange& range) {
  std::vector<Series> all;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Setting& s = points[k].setting;
    auto at = std::find_if(all.begin(), all.end(), [&](const Series& one) {
      return one.engine == s.engine && one.setting == series_setting(s);
    });
    if (at == all.end()) {
      Series fresh;
      fresh.engine = s.engine;
      fresh.setting = series_setting(s);
      at = all.insert(all.end(), fresh);
    }
    take(points, k, *at);
  }
  for (Series& series : all) {
    std::vector<double> steps, errors;
    for (const std::size_t k : series.points) {
      const Point& p = points[k];
      if (!p.setting.step || !p.finished()) continue;
      if (p.errors->position <= range.floor || p.errors->position >= range.ceiling) continue;
      steps.push_back(*p.setting.step);
      errors.push_back(p.errors->position);
    }
    series.order = fitted_order(steps, errors);
  }
  return all;
}

std::optional<double> fitted_order(const std::vector<double>& steps,
                                   const std::vector<double>& errors) {
  assert(steps.size() == errors.size());
  const auto n = static_cast<double>(steps.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double h = std::log(steps[k]), e = std::log(errors[k]);
    x += h;
    y += e;
    xx += h * h;
    xy += h * e;
  }
  const double spread = n * xx - x * x;
  if (steps.size() < 3 || spread <= 0.0) return {};
  return (n * xy - x * y) / spread;
}

std::string setting_text(const Setting& s) {
  if (!s.step) return s.setting;
  const std::string step = time_text(*s.step);
  return s.setting.empty() ? step : s.setting + ", " + step;
}

std::string outcomes_text(const Series& series) {
  std::string text;
  for (const auto& [outcome, count] : series.outcomes) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, to_string(outcome));
  }
  return text;
}

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
  bool reached = false, by_mujoco = false;
  for (const Level& level : levels) {
    if (!in_headline(level)) continue;
    const auto note = [&](std::optional<bool> verdict, bool& any, std::string& text) {
      any = any || verdict;
      if (verdict && !*verdict) text += fmt::format(" {:.0e}", level.share);
    };
    note(native_is_fastest(level), reached, native);
    note(rigid_is_fastest_mujoco(level), by_mujoco, rigid);
  }
  if (!reached) return "No engine reaches any of these levels.";
  const std::string overall =
      native.empty() ? "A native integrator is the fastest at every level that any engine reaches."
                     : fmt::format("A native integrator is the fastest, except at{}.", native);
  if (!by_mujoco) return overall + " No setting of MuJoCo reaches any of these levels.";
  return overall +
         (rigid.empty()
              ? " Among MuJoCo's settings, `rigid` is the fastest at every level that any "
                "of them reaches."
              : fmt::format(" Among MuJoCo's settings, `rigid` is the fastest, except at{}.",
                            rigid));
}

}  // namespace rotorub::bench
