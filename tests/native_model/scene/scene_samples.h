// Scenes that several tests modify in one place; bad ones, with a part replaced or added, and their
// messages.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "native_model/scene/reader.h"
#include "tests/support/refusal.h"
#include "tests/support/said.h"

namespace rotorub::scene {

// The smallest scene in modal form.
inline constexpr std::string_view kModalSample = R"([rotor]
speed = "50 Hz"
[rotor.modal]
mass = [2.0, 0.8]
stiffness = [2e5, 3e6]
[contact]
radius = 0.05
clearance = "0.5 mm"
friction = 0.15
restitution = 0.5
)";

// The smallest scene in geometry form.
inline constexpr std::string_view kGeometrySample = R"([rotor]
length = 0.6
E = 2.1e11
rho = 7850
modes = 2
[[rotor.section]]
from = 0.0
to = 0.6
diameter = "18 mm"
)";

// Everything that the modal form can hold: the public contract's example.
inline constexpr std::string_view kFullModalScene = R"([run]
end = 0.5
step = 1e-5
integrator = "event"
output_step = 1e-3
output_times = [0.4, 0.1234]
[rotor]
speed = "50 Hz"
[rotor.modal]
mass = [2.0, 0.8]
stiffness = [2e5, 3e6]
damping = [40.0, 60.0]
internal_damping = [0.0, 0.0]
gyroscopic = [0.0, 0.0]
inertia = 1e-3
[rotor.torsion]
inertia = [4e-4]
stiffness = [60.0]
damping = [0.01]
drive_shape = [0.0]
[drive]
kind = "linear"
gain = 0.5
speed = "50 Hz"
[contact]
radius = 0.05
clearance = "0.5 mm"
friction = 0.15
restitution = 0.5
tangential_restitution = 0.0
compression_time = 0.0
expansion_time = 0.0
[stator]
mass = 1.0
damping = [200.0, 300]
stiffness = 1e5
[[force]]
kind = "rotating"
amplitude = 150.0
frequency = "50 Hz"
phase = "90 deg"
on = 0.1
off = 1e9
ramp = 0.0
shape = [1.0, 1.0]
[[force]]
kind = "constant"
vector = [0.0, -20.0]
[initial]
x = [1e-4, 0.0]
spin_angle = 0.0
torsion = [0.0]
torsion_speed = [0.0]
stator = [0.0, 0.0]
stator_velocity = [0.0, 0.0]
)";

inline std::vector<Diagnostic> refusal(const std::string& text) {
  return test::refusals([&] { parse_scene(text, "s.toml"); });
}

struct Wrong {
  const char* why;
  std::string text;
  int line;
  const char* key;
  const char* reason;  // must stand in the message
};

inline void expect_refused(const std::vector<Wrong>& cases) {
  for (const Wrong& wrong : cases) {
    const std::vector<Diagnostic> found = refusal(wrong.text);
    ASSERT_EQ(found.size(), 1u) << wrong.why << (found.empty() ? "" : ": " + to_string(found[0]));
    EXPECT_EQ(found[0].file, "s.toml") << wrong.why;
    EXPECT_EQ(found[0].line, wrong.line) << wrong.why;
    EXPECT_EQ(found[0].key, wrong.key) << wrong.why;
    EXPECT_TRUE(test::contains(found[0].reason, wrong.reason)) << wrong.why;
  }
}

inline std::string modal(const std::string& from, const std::string& to) {
  return test::replaced(std::string(kModalSample), from, to);
}
inline std::string geometry(const std::string& from, const std::string& to) {
  return test::replaced(std::string(kGeometrySample), from, to);
}
inline std::string full(const std::string& from, const std::string& to) {
  return test::replaced(std::string(kFullModalScene), from, to);
}
inline std::string modal_and(const std::string& more) { return std::string(kModalSample) + more; }
inline std::string geometry_and(const std::string& more) {
  return std::string(kGeometrySample) + more;
}

}  // namespace rotorub::scene
