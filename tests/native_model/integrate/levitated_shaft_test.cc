// A shaft on one bearing, held by a magnetic one: its modes are found with the magnets' linear
// spring, and nothing but the modes kept may depend on that.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "native_model/linear/campbell.h"
#include "native_model/linear/rub_system.h"
#include "native_model/rotor/rotor_modes.h"
#include "native_model/run/run_native.h"
#include "native_model/scene/diagnostic.h"
#include "tests/support/levitated_shaft.h"
#include "tests/support/order.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

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

Trajectory run(const scene::Scene& s) {
  Trajectory t = run_native(s);
  EXPECT_EQ(t.status, Status::kOk) << t.message;
  return t;
}

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
  // The weight alone asks for 18 N / 100 N/A and more.
  const auto steady = [](const std::string& control) {
    return test::model_refusal(
        parse(kMagnets, {"initial.steady=true", "magnetic_bearing.control." + control}));
  };
  EXPECT_TRUE(test::contains(steady("current_limit=0.1"), "current_limit = 0.1 A"));
  EXPECT_EQ(steady("current_limit=2"), "");
  // Nothing holds it from the start.
  EXPECT_TRUE(test::contains(steady("fails_at=0"), "initial.steady"));
  // Beside the plain bearing it holds no tilt; without a control nothing.
  EXPECT_TRUE(
      test::contains(test::model_refusal(parse(kMagnets, {"magnetic_bearing.station=0.03"})),
                     "free to move as a rigid body"));
  EXPECT_TRUE(test::contains(test::model_refusal(parse("[magnetic_bearing]\nstation = 0.5\n"
                                                       "negative_stiffness = 1e4\n")),
                             "beside a [magnetic_bearing] with a control"));
}

}  // namespace
}  // namespace rotorub
