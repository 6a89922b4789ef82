#include "native_model/control/touch.h"

#include "native_model/contact/kinematics.h"

namespace rotorub {

SeenGap seen_gap(const Measurement& now, double clearance) {
  const Eigen::Vector2d d = now.rotor - now.stator;
  const double delta = d.norm();
  if (delta <= kNoNormal) return {clearance - delta, 0.0};
  return {clearance - delta, -d.dot(now.rotor_velocity - now.stator_velocity) / delta};
}

bool touched(const Measurement& now, double clearance, double* state) {
  enum : std::size_t {
    kDue,
    kRate
  };  // when the gap seen last would close, s (0: never), and its rate
  const SeenGap seen = seen_gap(now, clearance);
  const bool due = state[kDue] > 0.0 && now.t >= state[kDue] && seen.rate > state[kRate];
  state[kDue] = seen.rate < 0.0 ? now.t - seen.gap / seen.rate : 0.0;
  state[kRate] = seen.rate;
  // While contact lasts the gap is 0 but for what an engine's arithmetic leaves, of either sign.
  constexpr double kClosed = 1e-5;  // of the clearance
  return seen.gap <= kClosed * clearance || due;
}

}  // namespace rotorub
