// Drive torque on the rotor as a function of the speed at the motor, N m.
#pragma once

#include <vector>

#include "native_model/scene/scene.h"

namespace rotorub {

// linear: gain (speed - Omega).  free: 0.  kloss: 2 T_b s s_b / (s^2 + s_b^2) with the slip
// s = (synchronous - Omega) / synchronous, written without 0/0.  table: piecewise cubic, held
// constant beyond the ends.
class Drive {
 public:
  explicit Drive(const scene::Drive& drive);
  double torque(double speed) const;  // speed: rad/s at the motor
  // d torque / d speed, N m s.
  double slope(double speed) const;
  scene::DriveKind kind() const { return drive_.kind; }
  double target() const { return drive_.speed; }  // rad/s, linear

 private:
  scene::Drive drive_;
  std::vector<double> tangents_;  // of the table
};

}  // namespace rotorub
