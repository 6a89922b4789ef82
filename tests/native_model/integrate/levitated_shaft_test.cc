// A shaft on one bearing, held by a magnetic one: its modes are found with the magnets' linear
// spring, and nothing but the modes kept may depend on that.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "native_model/dynamics/dynamics.h"
#include "native_model/rotor/campbell.h"
#include "native_model/rotor/rotor_modes.h"
#include "native_model/rub/rub_system.h"
#include "native_model/run/run_native.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "tests/support/levitated_shaft.h"
#include "tests/support/order.h"

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

// A bearing with the magnets' stiffness and damping in their place: the same motion, to round-off.
// Without modal damping: magnets have none, a bearing's mode its share.
TEST(LevitatedShaft, IsThatOnASpringAndADamper) {
  for (const char* start : {"initial.steady=true", "initial={vx=[0.02,0.01,0.0,0.0]}"}) {
    SCOPED_TRACE(start);
    const Trajectory magnets = run(undamped(kMagnets, {start}));
    const Trajectory bearing = run(undamped(kBearing, {start}));
    EXPECT_GT(std::abs(magnets.column("rotor_y").back()), 1e-5);  // it moves
    EXPECT_LT(test::rotor_error(magnets, bearing), 1e-9 * 0.3e-3);
    EXPECT_LT(magnets.statistics.energy_residual(), 1e-9);
  }
  const WhirlSpectrum a = whirl_spectrum(whirl_system(undamped(kMagnets)), 300.0);
  const WhirlSpectrum b = whirl_spectrum(whirl_system(undamped(kBearing)), 300.0);
  ASSERT_EQ(a.modes.size(), b.modes.size());
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_NEAR(a.modes[k].frequency, b.modes[k].frequency, 1e-8 * std::abs(b.modes[k].frequency));
    EXPECT_NEAR(a.modes[k].damping_ratio, b.modes[k].damping_ratio, 1e-8) << k;
  }
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
  EXPECT_EQ(support.held, 3e5);
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
    try {
      rub::rub_system(
          parse(kMagnets, {"gravity=none", std::string("magnetic_bearing.control.") + key}));
      ADD_FAILURE() << key;
    } catch (const scene::SceneError& error) {
      EXPECT_NE(std::string(error.what()).find("no lasting rub can be analysed"),
                std::string::npos);
    }
  }
}

TEST(LevitatedShaft, RefusesWhatItCannotDo) {
  // The weight alone asks for 18 N / 100 N/A and more.
  const std::string steady = test::model_refusal(
      parse(kMagnets, {"initial.steady=true", "magnetic_bearing.control.current_limit=0.1"}));
  EXPECT_NE(steady.find("current_limit = 0.1 A"), std::string::npos) << steady;
  EXPECT_EQ(test::model_refusal(parse(
                kMagnets, {"initial.steady=true", "magnetic_bearing.control.current_limit=2"})),
            "");
  // Nothing holds it from the start.
  const std::string failed = test::model_refusal(
      parse(kMagnets, {"initial.steady=true", "magnetic_bearing.control.fails_at=0"}));
  EXPECT_NE(failed.find("initial.steady"), std::string::npos) << failed;
  // Beside the plain bearing it holds no tilt; without a control nothing.
  const std::string together =
      test::model_refusal(parse(kMagnets, {"magnetic_bearing.station=0.03"}));
  EXPECT_NE(together.find("free to move as a rigid body"), std::string::npos) << together;
  const std::string alone =
      test::model_refusal(parse("[magnetic_bearing]\nstation = 0.5\nnegative_stiffness = 1e4\n"));
  EXPECT_NE(alone.find("beside a [magnetic_bearing] with a control"), std::string::npos) << alone;
}

}  // namespace
}  // namespace rotorub
