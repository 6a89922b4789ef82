#include "compare/measured/sampled_run.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "compare/metrics/rows.h"

namespace rotorub {

SampleTimes sample_times(std::span<const double> t, double interval) {
  SampleTimes times{{t.begin(), t.end()}, {}, {}};
  const auto half = [&](double apart) { return 0.5 * (apart < 2.0 * interval ? apart : interval); };
  for (std::size_t i = 0; i < t.size(); ++i) {
    times.from.push_back(t[i] - half(i > 0 ? t[i] - t[i - 1] : interval));
    times.to.push_back(t[i] + half(i + 1 < t.size() ? t[i + 1] - t[i] : interval));
  }
  return times;
}

void SampleTimes::add(const SampleTimes& others, std::size_t index) {
  t.push_back(others.t[index]);
  from.push_back(others.from[index]);
  to.push_back(others.to[index]);
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
  const std::vector<double>& force = run.column("normal_force");
  momentum_ = {0.0};
  for (std::size_t i = 1; i < t_->size(); ++i) {
    const double given = 0.5 * ((*t_)[i] - (*t_)[i - 1]) * (force[i - 1] + force[i]);
    momentum_.push_back(momentum_.back() + given);
  }
  if (!run.is_rigid()) return;  // a soft contact is already included in the force
  std::vector<Impact> impacts;
  std::copy_if(run.impacts.begin(), run.impacts.end(), std::back_inserter(impacts),
               [&](const Impact& i) { return i.t >= start() && i.t <= end(); });
  std::stable_sort(impacts.begin(), impacts.end(),
                   [](const Impact& a, const Impact& b) { return a.t < b.t; });
  double sum = 0.0;
  for (const Impact& impact : impacts) {
    impact_t_.push_back(impact.t);
    impact_momentum_.push_back(sum += impact.normal_impulse);
  }
}

bool SampledRun::has(const Measurable& what) const {
  return what.series.empty() ? !momentum_.empty() : run_->has(std::string(what.series));
}

std::vector<double> SampledRun::momentum_at(std::span<const double> t) const {
  std::vector<double> all = linear(*t_, momentum_, t);
  for (std::size_t k = 0; k < t.size(); ++k) {
    const auto next = std::upper_bound(impact_t_.begin(), impact_t_.end(), t[k]);
    if (next == impact_t_.begin()) continue;
    all[k] += impact_momentum_[static_cast<std::size_t>(next - impact_t_.begin()) - 1];
  }
  return all;
}

std::vector<double> SampledRun::values(const Measurable& what, const SampleTimes& times) const {
  assert(has(what));
  if (what.series.empty()) {
    std::vector<double> mean = momentum_at(times.to);
    const std::vector<double> before = momentum_at(times.from);
    for (std::size_t i = 0; i < mean.size(); ++i) {
      mean[i] = (mean[i] - before[i]) / (times.to[i] - times.from[i]);
    }
    return mean;
  }
  const std::vector<double>& y = run_->column(std::string(what.series));
  const std::string rate(what.rate);
  if (rate.empty() || !run_->has(rate)) return linear(*t_, y, times.t);
  return cubic(*t_, y, run_->column(rate), times.t);
}

std::vector<double> SampledRun::values(const Measurable& what, const SampleTimes& times,
                                       double angle) const {
  std::vector<double> own = values(what, times);
  if (what.axis == Axis::kNone || angle == 0.0) return own;
  const std::vector<double> other = values(other_axis(what), times);
  const double c = std::cos(angle), s = std::sin(what.axis == Axis::kX ? angle : -angle);
  for (std::size_t i = 0; i < own.size(); ++i) own[i] = c * own[i] + s * other[i];
  return own;
}

}  // namespace rotorub
