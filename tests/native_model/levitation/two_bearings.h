// Two modes of a turning rotor and two magnetic bearings with all that a loop may have.
#pragma once

#include <string>

namespace rotorub::test {

// modal: lines of [rotor.modal] beside mass, stiffness and gyroscopic; law: lines of the first
// bearing's control, of which 3,000 A/m and 4 A s/m are there; rest: tables that follow.
inline std::string two_bearings(const std::string& speed, const std::string& modal,
                                const std::string& law, const std::string& rest) {
  return "[rotor]\nspeed = " + speed + R"(
[rotor.modal]
mass = [2.0, 0.7]
stiffness = [1e5, 9e5]
gyroscopic = [0.05, 0.02]
)" + modal +
         R"(
[contact]
clearance = 1e-3
radius = 0.05
friction = 0.1
restitution = 0.5
[[magnetic_bearing]]
shape = [1.0, 1.0]
sensor_shape = [0.9, 0.8]
negative_stiffness = 3e4
[magnetic_bearing.control]
force_per_current = 40.0
proportional = 3000.0
derivative = 4.0
)" + law +
         R"(
[magnetic_bearing.amplifier]
bandwidth = 8000.0
[[magnetic_bearing]]
shape = [0.5, -0.6]
negative_stiffness = 2e4
[magnetic_bearing.control]
force_per_current = 60.0
proportional = 1500.0
derivative = 1.0
)" + rest;
}

}  // namespace rotorub::test
