// Several magnetic bearings, each with its own feedback, limit and failure: a free shaft that they
// alone hold, against springs and dampers.
#include <gtest/gtest.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "native_model/linear/campbell.h"
#include "native_model/linear/rub_system.h"
#include "native_model/model/model.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/prepare/prepare.h"
#include "native_model/rotor/rotor_modes.h"
#include "native_model/run/run_native.h"
#include "native_model/scene/diagnostic.h"
#include "tests/support/levitated_shaft.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

using test::run_event;
using test::run_with;

// k_i P - k_s: 3e5 and 2e5 N/m; k_i D: 400 and 250 N s/m.
constexpr const char* kTwoMagnets = R"(
[[magnetic_bearing]]
station = 0.08
negative_stiffness = 2e5
[magnetic_bearing.control]
force_per_current = 100.0
proportional = 5000.0
derivative = 4.0
[[magnetic_bearing]]
station = 0.52
negative_stiffness = 1e5
[magnetic_bearing.control]
force_per_current = 50.0
proportional = 6000.0
derivative = 5.0
)";
constexpr const char* kTwoBearings = R"(
[[rotor.bearing]]
z = 0.08
stiffness = 3e5
damping = 400.0
[[rotor.bearing]]
z = 0.52
stiffness = 2e5
damping = 250.0
)";
scene::Scene levitated_by_two(const std::string& tail,
                              const std::vector<std::string>& overrides = {}) {
  return test::held_shaft(tail, overrides);
}

std::string refusal_of(const std::string& tail, const std::vector<std::string>& overrides = {}) {
  return test::message_of<scene::SceneError>([&] { prepare(levitated_by_two(tail, overrides)); });
}

TEST(MagneticBearings, HoldAShaftAsTwoSpringsAndDampersDo) {
  for (const char* start : {"initial.steady=true", "initial={vx=[0.02,0.01,0.0,0.0]}"}) {
    SCOPED_TRACE(start);
    const Trajectory magnets = run_event(levitated_by_two(kTwoMagnets, {start}));
    const Trajectory bearings = run_event(levitated_by_two(kTwoBearings, {start}));
    EXPECT_GT(std::abs(magnets.column("rotor_y").back()), 1e-5);
    EXPECT_LT(test::rotor_error(magnets, bearings), 1e-9 * 0.3e-3);
    EXPECT_LT(magnets.statistics.energy_residual(), 1e-9);
  }
  const WhirlSpectrum a = whirl_spectrum(whirl_system(levitated_by_two(kTwoMagnets)), 300.0);
  const WhirlSpectrum b = whirl_spectrum(whirl_system(levitated_by_two(kTwoBearings)), 300.0);
  ASSERT_EQ(a.modes.size(), b.modes.size());
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_NEAR(a.modes[k].frequency, b.modes[k].frequency, 1e-8 * std::abs(b.modes[k].frequency));
    EXPECT_NEAR(a.modes[k].damping_ratio, b.modes[k].damping_ratio, 1e-8) << k;
  }
}

// M = (m, 0; 0, J) of (displacement of the centre of mass, tilt) on the springs at their arms.
TEST(MagneticBearings, HoldARigidShaftAtTheFrequenciesOfTheirSprings) {
  const scene::Scene s =
      levitated_by_two(kTwoMagnets, {"rotor.E=2.1e17", "magnetic_bearing.control.derivative=0"});
  const double radius = 0.009, line = 7850.0 * M_PI * radius * radius, shaft_mass = 0.6 * line;
  const double mass = shaft_mass + 2.0, centre = (shaft_mass * 0.3 + 2.0 * 0.35) / mass;
  const double inertia = shaft_mass * (0.03 + (0.3 - centre) * (0.3 - centre)) +
                         0.25 * shaft_mass * radius * radius + 1.8e-3 +
                         2.0 * (0.35 - centre) * (0.35 - centre);
  const double a = 0.08 - centre, b = 0.52 - centre, ka = 3e5, kb = 2e5;
  Eigen::Matrix2d m, k;
  m << mass, 0.0, 0.0, inertia;
  k << ka + kb, ka * a + kb * b, ka * a + kb * b, ka * a * a + kb * b * b;
  const Eigen::VectorXd exact = symmetric_eigenvalues(k, m)->cwiseSqrt();
  const WhirlSpectrum spectrum = whirl_spectrum(whirl_system(s), 0.0);
  for (const double omega : exact) {
    EXPECT_TRUE(std::any_of(spectrum.modes.begin(), spectrum.modes.end(), [&](const auto& mode) {
      return std::abs(std::abs(mode.frequency) - omega) < 1e-5 * omega;
    })) << omega;
  }
}

// The weight finally acts on the integrators' currents, and a steady start has them at once.
TEST(MagneticBearings, IntegratorsCarryTheWeightFromASteadyStart) {
  const Trajectory t = run_event(levitated_by_two(
      kTwoMagnets,
      {"rotor.E=2.1e18", "rotor.modes=2", "run.end=0.02", "magnetic_bearing.control.integral=2e5",
       "initial.steady=true", "rotor.disc[0].eccentricity=0"}));
  const double line = 7850.0 * M_PI * 0.009 * 0.009 * 0.6, g = 9.81;
  const double at_second = (line * (0.3 - 0.08) + 2.0 * (0.35 - 0.08)) / 0.44 * g;
  const double at_first = (line + 2.0) * g - at_second;
  for (const std::size_t k : {std::size_t{0}, t.rows() - 1}) {
    EXPECT_NEAR(100.0 * t.column("bearing_current_y")[k], at_first, 1e-6 * at_first);
    EXPECT_NEAR(50.0 * t.column("bearing2_current_y")[k], at_second, 1e-6 * at_second);
    EXPECT_NEAR(t.column("rotor_x")[k], 0.0, 1e-12);
  }
}

TEST(MagneticBearings, RefuseWhatTheyCannotHold) {
  const std::string one =
      std::string(kTwoMagnets).substr(0, std::string(kTwoMagnets).rfind("[[mag"));
  EXPECT_TRUE(test::contains(refusal_of(one), "or two such magnetic bearings"));
  EXPECT_TRUE(
      test::contains(refusal_of(kTwoMagnets, {"magnetic_bearing[1].control.proportional=1000"}),
                     {"magnetic_bearing[1].control.proportional", "give more than 2000 A/m"}));
  EXPECT_TRUE(test::contains(
      refusal_of(kTwoMagnets,
                 {"initial.steady=true", "magnetic_bearing[1].control.current_limit=0.01"}),
      "magnetic_bearing[1].control.current_limit = 0.01 A"));
  EXPECT_TRUE(test::contains(refusal_of(kTwoMagnets, {"magnetic_bearing[1].control=none",
                                                      "magnetic_bearing[1].sensor_station=0.5"}),
                             "belongs to the sensor of magnetic_bearing[1].control"));
  EXPECT_TRUE(test::contains(refusal_of(kTwoMagnets, {"magnetic_bearing[0].sensor_station=0.7"}),
                             "magnetic_bearing[0].sensor_station"));
  std::string many;
  for (int k = 0; k < 9; ++k) {
    many += "[[magnetic_bearing]]\nstation = 0." + std::to_string(k) + "\nnegative_stiffness = 1\n";
  }
  EXPECT_TRUE(test::contains(refusal_of(kTwoBearings + many), "at most 8"));
}

// ---------------------------------------------------------------- without a spring
// A shaft on one bearing, held by a magnetic one: its modes are found with the magnets' linear
// spring, and nothing but the modes kept may depend on that.

// k_i P - k_s = 3e5 N/m, k_i D = 400 N s/m.
constexpr const char* kMagnets = R"(
[magnetic_bearing]
station = 0.52
negative_stiffness = 2e5
[magnetic_bearing.control]
force_per_current = 100.0
proportional = 5000.0
derivative = 4.0
)";
constexpr const char* kBearing = R"(
[[rotor.bearing]]
z = 0.52
stiffness = 3e5
damping = 400.0
)";
constexpr const char* kPlainBearing = R"(
[[rotor.bearing]]
z = 0.03
stiffness = 2e7
)";

scene::Scene parse(const std::string& tail, const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> all{"rotor.damping_ratio=0.01", "rotor.internal_damping_ratio=0.004"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return test::held_shaft(kPlainBearing + tail, all);
}

scene::Scene undamped(const std::string& tail, std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.end(), {"rotor.damping_ratio=0", "rotor.internal_damping_ratio=0"});
  return parse(tail, overrides);
}

Trajectory run(const scene::Scene& s) { return test::complete(run_native(s)); }

// On two bearings of its own a shaft needs no magnets, and one whose magnets have failed at once is
// the same shaft, but its modes are found with their spring. Both kinds of modal damping too.
TEST(LevitatedShaft, DoesNotHangOnTheSpringOfItsModes) {
  const std::string held = "[[rotor.bearing]]\nz = 0.57\nstiffness = 2e6\n";
  const auto error = [&](int modes) {
    const std::vector<std::string> more = {"run.end=0.01", "contact.clearance=0.01",
                                           "rotor.modes=" + std::to_string(modes)};
    std::vector<std::string> failed = more;
    failed.push_back("magnetic_bearing.control.fails_at=0");
    const Trajectory without = run(parse(held, more)), with = run(parse(held + kMagnets, failed));
    EXPECT_GT(std::abs(with.column("rotor_y").back()), 5e-6);
    EXPECT_LT(with.statistics.energy_residual(), 1e-9);
    return test::rotor_error(with, without);
  };
  const double few = error(3), more = error(6), many = error(12);
  EXPECT_LT(more, 0.3 * few);
  EXPECT_LT(many, 0.3 * more);
  EXPECT_LT(many, 1e-8);
}

// A rigid shaft falls about its bearing: psi'' = g integral(z dm) / J, J about the bearing. Its
// damping ratio is of bending alone.
TEST(LevitatedShaft, FallsAsAPendulumAboutItsBearing) {
  constexpr double kGravity = 9.81, kFails = 2e-3, kContact = 0.46, kPivot = 0.03;
  scene::Scene s =
      parse(kMagnets, {"rotor.E=2.1e17", "rotor.modes=3", "rotor.disc[0].eccentricity=0",
                       "rotor.speed=0", "rotor.bearing[0].stiffness=1e15", "initial.steady=true",
                       "magnetic_bearing.control.fails_at=2e-3"});
  const double line = 7850.0 * std::numbers::pi * 0.009 * 0.009,
               tilt = 7850.0 * std::numbers::pi * std::pow(0.009, 4) / 4.0;
  const double a = -kPivot, b = 0.6 - kPivot, disc = 0.35 - kPivot;
  const double moment = line * (b * b - a * a) / 2.0 + 2.0 * disc;
  const double inertia =
      line * (b * b * b - a * a * a) / 3.0 + tilt * (b - a) + 2.0 * disc * disc + 1.8e-3;
  const double arm = kContact - kPivot, magnet = 0.52 - kPivot;
  const double sag = arm * kGravity * moment / (3e5 * magnet * magnet);
  const double fall = kGravity * moment / inertia * arm;
  const double touch = kFails + std::sqrt(2.0 * (0.3e-3 - sag) / fall);
  s.run.end = touch + 1e-5;
  const Trajectory t = run(s);
  ASSERT_FALSE(t.impacts.empty());
  EXPECT_NEAR(t.column("rotor_y").front(), -sag, 1e-5 * sag);
  EXPECT_NEAR(t.impacts[0].t, touch, 1e-5 * touch);
  EXPECT_NEAR(t.column("bearing_current_y").front(), 5000.0 * sag * magnet / arm, 1e-4);
}

TEST(LevitatedShaft, ThatHasFailedIsNoLongerHeld) {
  const scene::Scene s =
      parse(kMagnets, {"magnetic_bearing.control.fails_at=0", "gravity=none", "rotor.modes=8"});
  const MagneticSupport support = magnetic_support(s, s.magnetic_bearings[0]);
  EXPECT_EQ(support.stiffness, 0.0);
  EXPECT_EQ(support.damping, 0.0);
  EXPECT_EQ(support.modal_spring, 3e5);
  // One motion of each plane is left at a frequency of nearly 0, and the load meets no spring
  // there.
  const WhirlSpectrum spectrum = whirl_spectrum(whirl_system(s), 0.0);
  EXPECT_LT(std::abs(spectrum.modes[0].frequency), 1.0);
  EXPECT_GT(std::abs(spectrum.modes[4].frequency), 50.0);
}

TEST(LevitatedShaft, LastingRubsAreThoseOfALinearMachine) {
  const std::vector<std::string> base = {"gravity=none"};
  const rub::RubSystem magnets = rub::rub_system(undamped(kMagnets, base));
  const rub::RubSystem bearing = rub::rub_system(undamped(kBearing, base));
  EXPECT_LT((magnets.stiffness - bearing.stiffness).norm(), 1e-9 * bearing.stiffness.norm());
  EXPECT_LT((magnets.damping - bearing.damping).norm(), 1e-9 * bearing.damping.norm());
  for (const char* key : {"current_limit=2", "fails_at=0.1"}) {
    const scene::Scene s =
        parse(kMagnets, {"gravity=none", std::string("magnetic_bearing.control.") + key});
    EXPECT_TRUE(test::contains(test::message_of<scene::SceneError>([&] { rub::rub_system(s); }),
                               "no lasting rub can be analysed"));
  }
}

TEST(LevitatedShaft, RefusesWhatItCannotDo) {
  // The weight alone needs 18 N / 100 N/A and more.
  const auto steady = [](const std::string& control) {
    return test::model_refusal(
        parse(kMagnets, {"initial.steady=true", "magnetic_bearing.control." + control}));
  };
  EXPECT_TRUE(test::contains(steady("current_limit=0.1"), "current_limit = 0.1 A"));
  EXPECT_EQ(steady("current_limit=2"), "");
  // Nothing holds the rotor from the start.
  EXPECT_TRUE(test::contains(steady("fails_at=0"), "initial.steady"));
  // Beside the plain bearing it does not resist tilt; without a control it resists nothing.
  EXPECT_TRUE(
      test::contains(test::model_refusal(parse(kMagnets, {"magnetic_bearing.station=0.03"})),
                     "free to move as a rigid body"));
  EXPECT_TRUE(test::contains(test::model_refusal(parse("[magnetic_bearing]\nstation = 0.5\n"
                                                       "negative_stiffness = 1e4\n")),
                             "beside a [magnetic_bearing] with a control"));
}

}  // namespace
}  // namespace rotorub
