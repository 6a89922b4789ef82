// Drive torque on the rotor, N m: of most kinds a function of the speed at the motor.
#pragma once

#include "native_model/numerics/monotone_cubic.h"
#include "native_model/scene/drive.h"

namespace rotorub {

// linear: gain (speed - Omega).  free: 0.  kloss: 2 T_b s s_b / (s^2 + s_b^2) with the slip
// s = (synchronous - Omega) / synchronous, written without 0/0.  table: piecewise cubic, held
// constant beyond the ends.
//
// speed_controlled: PI on the speed at the motor, within what the motor can give,
//
//   T = clamp(gain (ref - Omega) + clamp(integral_gain (a_ref - a))), clamped at +- torque_limit,
//   ref = start + sign(speed - start) acceleration t, until it has come to `speed`,
//
// a_ref the integral of ref and a that of Omega, from 0 on. a is the angle that the motor has
// turned by: a coordinate that there is anyhow, so that the integrator needs no state of its own.
// What is left behind while the torque is at its limit is made up for later; as the integral's part
// is limited too, by torque_limit/gain at most.
class Drive {
 public:
  // start: rad/s, the rotor's speed at t = 0; used by speed_controlled.
  explicit Drive(const scene::Drive& drive, double start = 0.0);
  // Kinds that know the speed alone; speed: rad/s at the motor.
  double torque(double speed) const;
  // Any kind; angle: rad, turned at the motor since t = 0.
  double torque(double t, double angle, double speed) const;
  // d torque / d speed, N m s; speed_controlled: within its limit.
  double slope(double speed) const;
  scene::DriveKind kind() const { return drive_.kind; }
  double target() const { return drive_.speed; }  // rad/s, linear and speed_controlled
  // The torque depends on time and angle too.
  bool follows() const { return drive_.kind == scene::DriveKind::kSpeedControlled; }
  // -d torque / d angle, N m, within its limit.
  double stiffness() const { return follows() ? drive_.integral_gain : 0.0; }
  double ramp_end() const { return ramp_end_; }  // s, from there on ref = speed; 0: always

 private:
  scene::Drive drive_;
  double start_, ramp_end_ = 0.0;
  MonotoneCubic table_;
};

}  // namespace rotorub
