#include "compare/bench/series.h"

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

}  // namespace rotorub::bench
