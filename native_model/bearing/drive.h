// Torque of the drive on the rotor, N m. For most kinds it depends only on the speed at the motor.
#pragma once

#include "native_model/numerics/monotone_cubic.h"
#include "native_model/scene/drive.h"

namespace rotorub {

// linear: gain (speed - Omega). free: 0. kloss: 2 T_b s s_b / (s^2 + s_b^2) with the slip
// s = (synchronous - Omega) / synchronous, a form without 0/0. table: piecewise cubic, held
// constant beyond the ends.
//
// speed_controlled: PI control of the speed at the motor, within the motor's torque limit,
//
//   T = clamp(gain (ref - Omega) + clamp(integral_gain (a_ref - a))), clamped at +- torque_limit,
//   ref = start + sign(speed - start) acceleration t, until it reaches `speed`,
//
// with a_ref and a the integrals of ref and Omega from t = 0. a is the rotation of the motor, which
// is a coordinate of the model, so that the integrator needs no state of its own. Lag that builds
// up at the torque limit is made up for later. Because the integral part is limited too, the
// overspeed for this is at most torque_limit/gain.
class Drive {
 public:
  // start: rad/s, the rotor's speed at t = 0; used by speed_controlled.
  explicit Drive(const scene::Drive& drive, double start = 0.0);
  // Torque in N m of a kind that depends only on the speed (rad/s at the motor).
  double torque(double speed) const;
  // Torque in N m of any kind at t (s). angle: rad, rotation of the motor since t = 0.
  double torque(double t, double angle, double speed) const;
  // d torque / d speed, N m s; for speed_controlled within the torque limit.
  double slope(double speed) const;
  scene::DriveKind kind() const { return drive_.kind; }
  double target() const { return drive_.speed; }  // rad/s, linear and speed_controlled
  // True if the torque also depends on time and angle.
  bool follows() const { return drive_.kind == scene::DriveKind::kSpeedControlled; }
  // -d torque / d angle, N m/rad, within the torque limit.
  double stiffness() const { return follows() ? drive_.integral_gain : 0.0; }
  double ramp_end() const { return ramp_end_; }  // s, from then on ref = speed; 0: always

 private:
  scene::Drive drive_;
  double start_, ramp_end_ = 0.0;
  MonotoneCubic table_;
};

}  // namespace rotorub
