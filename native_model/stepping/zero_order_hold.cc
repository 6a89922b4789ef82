#include "native_model/stepping/zero_order_hold.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "native_model/bearing/actuator.h"
#include "native_model/control/control_loop.h"
#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"
#include "native_model/stepping/stepped_loads.h"

namespace rotorub {

const Eigen::Vector2d& ZeroOrderHold::at(double t, const double* q, const double* v) {
  if (!bearing().controller || t < bearing().control_on) return held_;
  if (bearing().sample_time > 0.0) {
    const double sample = sample_index(t, bearing().sample_time);
    if (sample == last_sample_) return held_;
    last_sample_ = sample;
  }
  held_ = command(t, q, v);
  return held_;
}

Eigen::Vector2d ZeroOrderHold::command(double t, const double* q, const double* v) {
  const Model& m = *model_;
  if (!bearing().loop) return control_command(m, t, q, v, bearing_);
  return sampled_.take(t, q, v, held_, currents_ ? &*currents_ : nullptr);
}

// s, infinity if there is none. The first sample is at switch-on, the others are at multiples of
// the sample time.
double ZeroOrderHold::next_sample() const {
  if (!bearing().controller) return std::numeric_limits<double>::infinity();
  if (last_sample_ < 0.0) return bearing().control_on;
  return (last_sample_ + 1.0) * bearing().sample_time;
}

bool ZeroOrderHold::needs_state(double end) const {
  if (!bearing().controller) return false;
  const double first = bearing().sample_time > 0.0 ? next_sample() : bearing().control_on;
  return first <= end;
}

Eigen::Vector2d ZeroOrderHold::mean(double begin, double t, double end, const double* q,
                                    const double* v, const double* a) {
  if (!needs_state(end)) return held_;
  const Model& m = *model_;
  double now_q[kMaxCoordinates], now_v[kMaxCoordinates];
  const auto take = [&](double instant) {
    const double s = instant - t;
    for (int i = 0; i < m.nq(); ++i) {
      now_q[i] = q[i] + s * (v[i] + 0.5 * s * a[i]);
      now_v[i] = v[i] + s * a[i];
    }
    // For a sampled law, the states that remember samples of magnetic bearings are shown as their
    // last samples left them. v contains half of the change by this step's samples, the mean, which
    // only a continuous law must see.
    for (int i = m.sampled_states(); i < m.layout.coil() && bearing().loop; ++i)
      now_v[i] = v[i] + (begin - t) * a[i];
    held_ = command(std::max(instant, bearing().control_on), now_q, now_v);
  };
  // Magnets without a coil lag turn currents into forces at once, so the mean is taken of the
  // forces.
  const bool forces = bearing().magnets && bearing().coil == kAbsent;
  const Eigen::Vector2d s =
      forces ? to_axes(stator_point(m, q, bearing_)) : Eigen::Vector2d::Zero();
  const auto acts = [&](const Eigen::Vector2d& command) -> Eigen::Vector2d {
    if (!forces) return command;
    const ForceLaw& law = *bearing().magnets->law;
    return {law.force(s.x(), command.x()), law.force(s.y(), command.y())};
  };
  Eigen::Vector2d sum{0.0, 0.0}, before{0.0, 0.0};
  double from = begin;
  command_jump_ = {};
  const auto until = [&](double instant) {
    const double to = std::clamp(instant, from, end);
    if (command_jump_.share == 0.0 && from > begin && to > from) {
      command_jump_.share = (from - begin) / (end - begin);
      before = sum;
    }
    sum += (to - from) * acts(held_);
    from = to;
  };
  if (bearing().sample_time > 0.0) {
    // A sample at the very end holds from the start of the next step.
    for (double instant = next_sample(); instant < end; instant = next_sample()) {
      until(instant);
      take(instant);
      last_sample_ = sample_index(instant, bearing().sample_time);
    }
  } else {
    // A switched load makes a command jump that feeds loads forward.
    if (bearing().control_on > begin) until(bearing().control_on);
    for (double instant = next_switch(m, from, end); from < end;
         instant = next_switch(m, from, end)) {
      const double last = std::nextafter(instant, begin);
      take(instant < end ? std::clamp(t, from, last) : std::max(t, from));
      until(instant);
    }
  }
  until(end);
  if (command_jump_.share == 0.0) return held_;
  const auto mean_of = [&](const Eigen::Vector2d& part, double time) -> Eigen::Vector2d {
    const Eigen::Vector2d mean = part / time;
    if (!forces) return mean;
    const MagneticActuator& magnets = *bearing().magnets;
    return {magnets.law->current(s.x(), mean.x(), magnets.current_limit),
            magnets.law->current(s.y(), mean.y(), magnets.current_limit)};
  };
  const double whole = end - begin;
  command_jump_.before = mean_of(before, command_jump_.share * whole);
  command_jump_.after = mean_of(sum - before, (1.0 - command_jump_.share) * whole);
  return mean_of(sum, whole);
}

std::size_t ZeroOrderHold::memory_size(const Model& model) {
  return 3 + SampledCommand::memory_size(model);
}

void ZeroOrderHold::save(double* to) const {
  to[0] = held_.x();
  to[1] = held_.y();
  to[2] = last_sample_;
  sampled_.save(to + 3);
}

void ZeroOrderHold::restore(const double* from) {
  held_ = {from[0], from[1]};
  last_sample_ = from[2];
  sampled_.restore(from + 3);
}

}  // namespace rotorub
