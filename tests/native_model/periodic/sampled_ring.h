// A rotor of one mode in a ring with a sampled controller.
#pragma once

#include <string>
#include <vector>

#include "tests/support/native_run.h"

namespace rotorub::test {

// more: keys of the controller and its sensors. The force turns with the rotor at 50 Hz.
inline scene::Scene sampled_ring(const std::vector<std::string>& more, double force = 150.0) {
  std::string text = R"(
[run]
end = 0.4
[rotor]
speed = "50 Hz"
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
[contact]
radius = 0.05
clearance = "0.5 mm"
friction = 0.15
restitution = 0.3
[stator]
mass = 1.0
damping = 200.0
stiffness = 1e5
[actuator]
force_limit = 1000.0
[[force]]
kind = "synchronous"
)";
  text += "amplitude = " + std::to_string(force) + "\n[controller]\nsample_time = \"200 us\"\n";
  return scene::parse_scene(text, "sampled_ring", more);
}

// The laws with their sensors, of every kind of memory: held commands, delays, differences of
// positions, an observer, means, layers, a hand-over, currents of lagging coils.
inline std::vector<std::vector<std::string>> sampled_laws() {
  const std::string law = "controller.kind=";
  const std::string sensors = "controller.sensors.";
  const std::vector<std::string> feedback{law + "\"cross_coupled\"", "controller.feedback=[300.0]",
                                          "controller.feedback_speed=[\"50 Hz\"]",
                                          "controller.damping=300.0"};
  const auto with = [](std::vector<std::string> all, const std::vector<std::string>& more) {
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  return {
      feedback,
      with(feedback, {sensors + "velocity=\"difference\""}),
      with(feedback, {sensors + "delay=\"400 us\"", sensors + "velocity=\"difference\""}),
      {law + "\"lqg\"", sensors + "velocity=\"none\""},
      {law + "\"sliding\"", "controller.gap_time=\"8 ms\""},
      {law + "\"sliding\"", "controller.gap_time=\"8 ms\"", "controller.layer=\"adaptive\""},
      with(feedback, {law + "\"two_phase\"", "controller.gap_time=\"8 ms\""}),
      with(feedback,
           {"actuator.force_limit=none", "actuator.kind=\"electromagnet\"",
            "actuator.force_constant=416.7e-6", "actuator.bias_current=3.0",
            "actuator.air_gap=5e-3", "actuator.coil_lag=1e-4", sensors + "delay=\"200 us\""}),
  };
}

}  // namespace rotorub::test
