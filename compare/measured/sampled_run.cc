#include "compare/measured/sampled_run.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

namespace rotorub {
namespace {

using Values = std::vector<double>;

// Calls each(k, row, share): that the k-th time stands so far between row and the next. Times ascend.
template <class Each>
void along(const Values& rows, std::span<const double> t, Each each) {
  std::size_t row = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    const auto from = rows.begin() + static_cast<std::ptrdiff_t>(row) + 1;
    // Mostly the next few rows.
    if (row + 2 < rows.size() && rows[row + 1] <= t[k]) {
      row = static_cast<std::size_t>(std::upper_bound(from, rows.end() - 1, t[k]) - rows.begin()) - 1;
    }
    const double h = rows[row + 1] - rows[row];
    const double share = h > 0.0 ? std::clamp((t[k] - rows[row]) / h, 0.0, 1.0) : t[k] < rows[row] ? 0.0 : 1.0;
    each(k, row, share, h);
  }
}

Values linear(const Values& rows, const Values& y, std::span<const double> t) {
  Values out(t.size());
  along(rows, t, [&](std::size_t k, std::size_t row, double s, double) {
    out[k] = s == 0.0 ? y[row] : s == 1.0 ? y[row + 1] : y[row] + s * (y[row + 1] - y[row]);
  });
  return out;
}

Values cubic(const Values& rows, const Values& y, const Values& rate, std::span<const double> t) {
  Values out(t.size());
  along(rows, t, [&](std::size_t k, std::size_t row, double s, double h) {
    const double r = 1.0 - s;
    out[k] = r * r * ((1.0 + 2.0 * s) * y[row] + s * h * rate[row]) +
             s * s * ((3.0 - 2.0 * s) * y[row + 1] - r * h * rate[row + 1]);
  });
  return out;
}

}  // namespace

SampleTimes sample_times(std::span<const double> t, double interval) {
  SampleTimes times{{t.begin(), t.end()}, {}, {}};
  const auto half = [&](double apart) { return 0.5 * (apart < 2.0 * interval ? apart : interval); };
  for (std::size_t i = 0; i < t.size(); ++i) {
    times.from.push_back(t[i] - half(i > 0 ? t[i] - t[i - 1] : interval));
    times.to.push_back(t[i] + half(i + 1 < t.size() ? t[i + 1] - t[i] : interval));
  }
  return times;
}

SampleTimes shifted(SampleTimes times, double by) {
  for (std::vector<double>* all : {&times.t, &times.from, &times.to}) {
    for (double& t : *all) t += by;
  }
  return times;
}

SampledRun::SampledRun(const Trajectory& run) : run_(&run), t_(&run.column("t")) {
  assert(run.rows() >= 2);
  if (!run.has("normal_force")) return;
  const Values& force = run.column("normal_force");
  std::vector<Impact> impacts;
  // An episode of soft contact is in the force already.
  if (run.contact_model == "rigid") impacts = run.impacts;
  std::stable_sort(impacts.begin(), impacts.end(), [](const Impact& a, const Impact& b) { return a.t < b.t; });
  double sum = 0.0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < t_->size(); ++i) {
    const double from = i > 0 ? (*t_)[i - 1] : (*t_)[0], to = (*t_)[i];
    const double f = i > 0 ? force[i - 1] : 0.0, g = i > 0 ? force[i] : 0.0;
    double at = from, passed = 0.0;
    const auto advance = [&](double t) {
      const double share = to > from ? (t - from) / (to - from) : 0.0;
      passed = (to - from) * share * (f + 0.5 * share * (g - f));
      at = t;
    };
    for (; next < impacts.size() && impacts[next].t <= to; ++next) {
      if (impacts[next].t < (*t_)[0]) continue;
      advance(std::max(impacts[next].t, from));
      momentum_t_.push_back(at);
      momentum_.push_back(sum + passed);
      sum += impacts[next].normal_impulse;
      momentum_t_.push_back(at);
      momentum_.push_back(sum + passed);
    }
    advance(to);
    sum += 0.5 * (to - from) * (f + g);
    momentum_t_.push_back(to);
    momentum_.push_back(sum);
  }
}

bool SampledRun::has(const Measurable& what) const {
  return what.series.empty() ? !momentum_.empty() : run_->has(std::string(what.series));
}

std::vector<double> SampledRun::mean_force(const SampleTimes& times) const {
  Values mean = linear(momentum_t_, momentum_, times.to);
  const Values before = linear(momentum_t_, momentum_, times.from);
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = (mean[i] - before[i]) / (times.to[i] - times.from[i]);
  return mean;
}

std::vector<double> SampledRun::values(const Measurable& what, const SampleTimes& times) const {
  assert(has(what));
  if (what.series.empty()) return mean_force(times);
  const Values& y = run_->column(std::string(what.series));
  const std::string rate(what.rate);
  if (rate.empty() || !run_->has(rate)) return linear(*t_, y, times.t);
  return cubic(*t_, y, run_->column(rate), times.t);
}

std::vector<double> values_in_frame(const SampledRun& run, const Measurable& what, const SampleTimes& times,
                                    double angle) {
  Values own = run.values(what, times);
  if (what.axis == Axis::kNone || angle == 0.0) return own;
  // x stands before its y.
  const Measurable& across = *(what.axis == Axis::kX ? &what + 1 : &what - 1);
  const Values other = run.values(across, times);
  const double c = std::cos(angle), s = what.axis == Axis::kX ? std::sin(angle) : -std::sin(angle);
  for (std::size_t i = 0; i < own.size(); ++i) own[i] = c * own[i] + s * other[i];
  return own;
}

}  // namespace rotorub
