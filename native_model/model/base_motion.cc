#include "native_model/model/base_motion.h"

#include <algorithm>
#include <cmath>

#include "native_model/control/control_loop.h"

namespace rotorub {
namespace {

// The angle of two independent normal numbers is uniform on the circle.
double random_phase(int seed, std::size_t line) {
  const auto sample = static_cast<std::int64_t>(line);
  return std::atan2(noise(seed, sample, 1), noise(seed, sample, 0));
}

}  // namespace

BaseMotion::BaseMotion(const scene::Base& base)
    : base_(base), direction_(std::cos(base.direction), std::sin(base.direction)) {
  base_.phase.resize(base.frequency.size(), 0.0);
  for (std::size_t j = 0; base.seed && j < base_.phase.size(); ++j)
    base_.phase[j] = random_phase(*base.seed, j);
  for (std::vector<double>* along : {&base_.acceleration_x, &base_.acceleration_y})
    along->resize(base.time.size(), 0.0);
  jumps_ = {base.on, base.off};
  if (!base.time.empty()) jumps_.insert(jumps_.end(), {base.time.front(), base.time.back()});
  breaks_ = base.time;
  breaks_.insert(breaks_.end(), {base.on, base.on + base.ramp, base.off});
  for (std::vector<double>* instants : {&jumps_, &breaks_}) {
    std::sort(instants->begin(), instants->end());
    instants->erase(std::unique(instants->begin(), instants->end()), instants->end());
  }
}

Eigen::Vector2d BaseMotion::of_table(double t) const {
  const std::vector<double>&time = base_.time, &x = base_.acceleration_x, &y = base_.acceleration_y;
  if (time.empty() || t < time.front() || t >= time.back()) return {0.0, 0.0};
  const auto next = std::upper_bound(time.begin(), time.end(), t);
  const auto k = static_cast<std::size_t>(next - time.begin());
  const double share = (t - time[k - 1]) / (time[k] - time[k - 1]);
  return {x[k - 1] + share * (x[k] - x[k - 1]), y[k - 1] + share * (y[k] - y[k - 1])};
}

Eigen::Vector2d BaseMotion::at(double t) const {
  if (t < base_.on || t >= base_.off) return {0.0, 0.0};
  double lines = 0.0;
  for (std::size_t j = 0; j < base_.frequency.size(); ++j)
    lines += base_.amplitude[j] * std::cos(base_.frequency[j] * t + base_.phase[j]);
  const bool rises = t < base_.on + base_.ramp;
  return (rises ? (t - base_.on) / base_.ramp : 1.0) * (of_table(t) + lines * direction_);
}

Eigen::Vector2d BaseMotion::mean(double from, double to) const {
  // Two-point Gauss rule between breaks; exact for the ramp times the table.
  const double place = 1.0 / std::sqrt(3.0);
  Eigen::Vector2d sum{0.0, 0.0};
  auto next = std::upper_bound(breaks_.begin(), breaks_.end(), from);
  for (double begin = from; begin < to;) {
    const double end = next == breaks_.end() ? to : std::min(*next++, to);
    const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
    sum += half * (at(middle - place * half) + at(middle + place * half));
    begin = end;
  }
  return sum / (to - from);
}

}  // namespace rotorub
