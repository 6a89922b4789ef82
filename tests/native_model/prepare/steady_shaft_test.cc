// [initial] steady: a shaft with every linear part, whose orbit must repeat after each period.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "native_model/bearing/actuator.h"
#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"
#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/run/run_native.h"
#include "native_model/scene/reader.h"
#include "tests/native_model/prepare/steady_scenes.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/refusal.h"

namespace rotorub {
namespace {

using test::magnetic_ring;
using test::steady;

// A shaft with gyroscopics, bearings that differ in the planes with dampers, rotating damping,
// unbalance on two discs, weight, a backward and a forward force.
scene::Scene shaft() {
  return scene::parse_scene(R"(
[run]
end = 0.1
step = 1e-5
[rotor]
speed = 400.0
length = 0.6
E = 2.1e11
rho = 7850.0
modes = 3
damping_ratio = 0.01
internal_damping_ratio = 0.002
[[rotor.section]]
from = 0.0
to = 0.6
diameter = 0.02
[[rotor.disc]]
z = 0.15
mass = 2.0
Jt = 5e-3
Jp = 1e-2
eccentricity = 20e-6
phase = 0.4
[[rotor.disc]]
z = 0.5
mass = 1.0
Jt = 2e-3
Jp = 4e-3
eccentricity = 30e-6
phase = 2.0
[[rotor.bearing]]
z = 0.03
stiffness = [2e7, 3e6]
damping = [100.0, 400.0]
[[rotor.bearing]]
z = 0.57
stiffness = [2e6, 1e7]
damping = 200.0
[magnetic_bearing]
station = 0.3
negative_stiffness = 1e4
[[force]]
kind = "rotating"
amplitude = 8.0
frequency = -400.0
phase = 0.5
station = 0.4
[[force]]
kind = "synchronous"
amplitude = 5.0
phase = 1.5
station = 0.2
[[force]]
kind = "constant"
vector = [10.0, 5.0]
station = 0.3
[contact]
station = 0.25
radius = 0.02
clearance = 0.5e-3
friction = 0.2
restitution = 0.4
[stator]
mass = 1.5
damping = 300.0
stiffness = [2e5, 1e5]
[gravity]
acceleration = [1.0, -9.81]
[initial]
steady = true
spin_angle = 0.2
)",
                            "shaft.toml");
}

// Largest change of any coordinate against the first period's rows, as a share of the amplitude:
// the most that any coordinate of its kind (place, speed) moves.
double unrest(const scene::Scene& s, scene::Integrator integrator, double step, int periods) {
  NativeOptions options;
  options.integrator = integrator;
  options.step = step;
  std::vector<double> times;
  const double period = 2.0 * std::numbers::pi / 400.0;
  for (int k = 0; k <= 7 * periods; ++k) times.push_back(period * k / 7.0);
  options.output_times = times;
  scene::Scene run = s;
  run.run.end = times.back();
  const Trajectory t = test::complete(run_native(run, options));
  EXPECT_EQ(t.statistics.first_touch, -1.0);
  double change[2] = {}, size[2] = {};
  for (const std::string name : {"x_1", "x_2", "x_3", "y_1", "y_2", "y_3", "vx_1", "vx_2", "vx_3",
                                 "vy_1", "vy_2", "vy_3", "stator_x", "stator_y"}) {
    const std::vector<double>& c = t.column(name);
    const int kind = name.front() == 'v' ? 1 : 0;
    for (std::size_t k = 0; k < c.size(); ++k) {
      EXPECT_NE(c[k], 0.0) << name;
      size[kind] = std::max(size[kind], std::abs(c[k]));
      change[kind] = std::max(change[kind], std::abs(c[k] - c[k % 7]));
    }
  }
  return std::max(change[0] / size[0], change[1] / size[1]);
}

TEST(SteadyOrbit, OfAWholeShaftRepeatsItself) {
  const scene::Scene s = shaft();
  EXPECT_LT(unrest(s, scene::Integrator::kEvent, 1e-5, 5), 1e-10);
  // A start that is 1 % off must be detected: the test does not accept any motion.
  scene::Scene off = s;
  off.initial.vx = {1e-3, 0.0, 0.0};
  EXPECT_GT(unrest(off, scene::Integrator::kEvent, 1e-5, 5), 1e-3);
}

// A fixed step has a steady orbit of its own, which comes to this one with the square of the step
// (paper takes its loads at the middle of the step, so that away from contact it is of order 2 as
// well).
TEST(SteadyOrbit, FixedStepsComeToItWithTheSquareOfTheStep) {
  const scene::Scene s = shaft();
  const double period = 2.0 * std::numbers::pi / 400.0;
  const double coarse = unrest(s, scene::Integrator::kVerlet, period / 700.0, 4);
  const double fine = unrest(s, scene::Integrator::kVerlet, period / 2800.0, 4);
  EXPECT_LT(coarse, 2e-3);
  EXPECT_NEAR(fine, coarse / 16.0, 0.2 * coarse / 16.0);
}

// ---------------------------------------------------------------- refusals
// [initial] steady refuses an orbit that touches, that nothing holds or bounds, or that does not
// exist yet.

std::string refusal(const scene::Scene& s) {
  const scene::Diagnostic d = test::refusal(s);
  EXPECT_TRUE(d.reason.empty() || d.key == "initial.steady") << d.key;
  return d.reason;
}

void expect_refused(const scene::Scene& s, const std::string& reason) {
  const std::string given = refusal(s);
  EXPECT_NE(given.find(reason), std::string::npos) << given;
}

TEST(SteadyOrbitRefusal, TouchesWithItsSize) {
  scene::Scene s = steady({.mass = 2.0, .damping = 40.0, .stiffness = 2e5});
  test::add_rotating_force(s, 99.0, 0.0);
  EXPECT_EQ(refusal(s), "");
  s.forces[0].amplitude = 101.0;
  expect_refused(s, "touches: it comes to 0.000505 m");
  expect_refused(s, "0.0005 m");
  // By the ring's own sag alone.
  scene::Scene sagging = steady({.mass = 1e-3, .damping = 40.0, .stiffness = 2e5});
  test::add_ring(sagging, 10.0, 1.0, 1e4);
  sagging.gravity = scene::Gravity{{0.0, -9.81}, {}};
  expect_refused(sagging, "touches");
}

TEST(SteadyOrbitRefusal, Unstable) {
  scene::Scene s = steady({.mass = 2.0, .damping = 8.0, .stiffness = 2e5, .speed = 900.0});
  s.rotor.modal->internal_damping = {60.0};
  expect_refused(s, "unstable at 900 rad/s, a motion at 318.6");
  s.rotor.speed = 300.0;
  EXPECT_EQ(refusal(s), "");
  s.magnetic_bearings = {scene::MagneticBearing{0.0, {}, 2.1e5}};
  expect_refused(s, "unstable");
}

TEST(SteadyOrbitRefusal, ResonanceAndNothingThatHolds) {
  scene::Scene s = steady({.mass = 2.0, .stiffness = 2e5});
  test::add_rotating_force(s, 1e-9, std::sqrt(1e5));
  expect_refused(s, "resonance");
  s.forces[0].frequency = 300.0;
  EXPECT_EQ(refusal(s), "") << "without damping, but off the resonance: it repeats itself";
  scene::Scene free = steady({.mass = 2.0});
  EXPECT_EQ(refusal(free), "") << "a free mass at rest";
  free.gravity = scene::Gravity{{0.0, -9.81}, {}};
  expect_refused(free, "nothing holds the rotor");
  scene::Scene ring = steady({.mass = 2.0, .stiffness = 2e7});
  test::add_ring(ring, 1.0, 1.0, 0.0);
  ring.gravity = free.gravity;
  expect_refused(ring, "nothing holds the ring");
}

TEST(SteadyOrbitRefusal, MagnetsThatPullTheRingAway) {
  // 4 k_m i_0^2 / s_0^3 = 1.08e6 N/m against 2e4.
  expect_refused(magnetic_ring(), "magnets");
}

TEST(SteadyOrbitRefusal, LoadsThatAreUnderWay) {
  scene::Scene s = steady({.mass = 2.0, .damping = 40.0, .stiffness = 2e5});
  test::add_constant_force(s, {1.0, 0.0});
  s.forces[0].on = -0.1;
  s.forces[0].ramp = 0.2;
  expect_refused(s, "still rising");
  s.forces[0].kind = scene::ForceKind::kPulse;
  s.forces[0].ramp = 0.0;
  s.forces[0].off = 0.1;
  expect_refused(s, "pulse is acting at");
}

TEST(SteadyOrbitRefusal, BesideAStartOfOnesOwn) {
  const std::string text = R"([rotor]
speed = 300.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
[stator]
mass = 1.0
stiffness = 1e5
[contact]
radius = 0.05
clearance = 0.5e-3
friction = 0.1
restitution = 0.5
[initial]
steady = true
)";
  EXPECT_NO_THROW(prepare(scene::parse_scene(text, "s.toml")));
  for (const char* key : {"x", "y", "vx", "vy", "stator", "stator_velocity"}) {
    const bool ring = std::string(key).starts_with("stator");
    const auto wrong = test::refusals([&] {
      scene::parse_scene(text + key + (ring ? " = [0.0, 0.0]\n" : " = [0.0]\n"), "s.toml");
    });
    ASSERT_EQ(wrong.size(), 1U) << key;
    EXPECT_EQ(wrong[0].key, std::string("initial.") + key);
    EXPECT_EQ(wrong[0].line, 17);
    EXPECT_NE(wrong[0].reason.find("steady"), std::string::npos);
  }
}

}  // namespace
}  // namespace rotorub
