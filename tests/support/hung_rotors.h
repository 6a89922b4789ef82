// A ring with a quadratic law around a rotor in two magnetic bearings whose feedbacks have states.
#pragma once

#include <string>
#include <vector>

#include "native_model/scene/reader.h"
#include "tests/support/said.h"

namespace rotorub::test {

// Two modes in two magnetic bearings, released with the ring displaced, far from contact.
inline constexpr const char* kLevitated = R"(
[run]
end = 0.02
output_step = 1e-4
[rotor]
speed = 314.0
[rotor.modal]
mass = [2.0, 0.8]
stiffness = [2e5, 3e6]
damping = [40.0, 60.0]
gyroscopic = [0.05, -0.02]
[contact]
radius = 0.05
clearance = 0.01
friction = 0.1
restitution = 0.5
[stator]
mass = 1.5
damping = 30.0
stiffness = 2e5
[initial]
x = [1e-4, 2e-5]
stator = [-1e-4, 5e-5]
[[magnetic_bearing]]
shape = [0.9, 0.4]
sensor_shape = [0.8, 0.3]
negative_stiffness = 3e4
control = {force_per_current = 40.0, proportional = 3000.0, FIRST}
AMPLIFIER
[[magnetic_bearing]]
shape = [0.5, -0.6]
negative_stiffness = 2e4
control = {force_per_current = 60.0, proportional = 1500.0, SECOND}
[controller]
kind = "KIND"
sample_time = 1e-4
)";

// The feedbacks of both bearings: keys of their controls, and the amplifier of the first.
struct Hanging {
  std::string name, first, amplifier, second;
  bool sampled = false;
};
inline std::vector<Hanging> hung_rotors() {
  const std::string amplifier = "amplifier = {bandwidth = 8000.0}";
  return {
      {"filter, integrator, amplifier", "derivative = 2.0, derivative_lag = 2e-4, integral = 3e4",
       amplifier, "derivative = 1.0"},
      {"sampled together with the ring's, two samples late",
       "derivative = 2.0, integral = 3e4, sample_time = 1e-4, delay = 2e-4", "",
       "derivative = 1.0, derivative_lag = 1e-4", true},
      {"sampled twice as often, behind an amplifier",
       "kind = 'transfer_function', numerator = [5000.0, -2000.0], denominator = [1.0, -0.2], "
       "sample_time = 5e-5, delay = 5e-5",
       amplifier, "derivative = 1.0, sample_time = 5e-5", true},
  };
}

inline scene::Scene levitated(const Hanging& loop, const std::string& kind) {
  std::string text = replaced(kLevitated, "FIRST", loop.first);
  text = replaced(replaced(text, "AMPLIFIER", loop.amplifier), "SECOND", loop.second);
  return scene::parse_scene(replaced(text, "KIND", kind), "levitated.toml", {});
}

}  // namespace rotorub::test
