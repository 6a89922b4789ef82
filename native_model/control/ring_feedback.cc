#include "native_model/control/ring_feedback.h"

#include <algorithm>
#include <cmath>

namespace rotorub {

double CrossCoupled::gain(double spin_speed) const {
  const double at = std::abs(spin_speed);
  if (gain_.size() == 1 || at <= speed_.front()) return gain_.front();
  if (at >= speed_.back()) return gain_.back();
  const auto next =
      static_cast<std::size_t>(std::upper_bound(speed_.begin(), speed_.end(), at) - speed_.begin());
  const double share = (at - speed_[next - 1]) / (speed_[next] - speed_[next - 1]);
  return (1.0 - share) * gain_[next - 1] + share * gain_[next];
}

Eigen::Vector2d CrossCoupled::command(const Measurement& now, const SwitchOn&, double*) const {
  const double k = std::copysign(gain(now.spin_speed), now.spin_speed);
  const Eigen::Vector2d& v = now.stator_velocity;
  return {k * v.y() - damping_ * v.x(), -k * v.x() - damping_ * v.y()};
}

Controller::Gains CrossCoupled::ring_gains() const {
  return {0.0, std::hypot(*std::max_element(gain_.begin(), gain_.end()), damping_)};
}

}  // namespace rotorub
