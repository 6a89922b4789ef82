// Critical speeds and the threshold of stability.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "native_model/linear/campbell.h"
#include "tests/native_model/rotor/rotors.h"

namespace rotorub {
namespace {

using test::jeffcott;
using test::kBeam;
using test::kShaft;
using test::kTight;
using test::miss;
using test::pinned_shaft;
using test::scene_of;

TEST(CriticalSpeeds, RayleighShaft) {
  const std::vector<double> speeds = critical_speeds(whirl_system(scene_of(pinned_shaft(6))));
  ASSERT_EQ(speeds.size(), 6u);
  for (int n = 1; n <= 6; ++n) {
    EXPECT_NEAR(speeds[static_cast<std::size_t>(n - 1)] / kShaft.critical_speed(n), 1.0, kBeam);
  }
}

// At a critical speed a whirl is synchronous with the spin.
TEST(CriticalSpeeds, LieOnTheCampbellDiagram) {
  const WhirlSystem isotropic = whirl_system(scene_of(oracle::friswell_rotor()));
  for (double speed : critical_speeds(isotropic)) {
    EXPECT_LT(miss(whirl_spectrum(isotropic, speed), speed), kTight);
  }
  const WhirlSystem anisotropic = whirl_system(test::anisotropic_rotor());
  const std::vector<double> speeds = critical_speeds(anisotropic);
  ASSERT_EQ(speeds.size(), 6u);
  for (double speed : speeds) {
    const WhirlSpectrum spectrum = whirl_spectrum(anisotropic, speed);
    EXPECT_LT(std::min(miss(spectrum, speed), miss(spectrum, -speed)), kTight);
  }
}

// The tilting whirl of a disc with J_p > J_t is always faster than the spin.
TEST(CriticalSpeeds, AFlatDiscHasFewer) {
  scene::Scene s = jeffcott(2.0, 2e5, 0.0);
  s.rotor.modal->gyroscopic = {2.5};
  EXPECT_TRUE(critical_speeds(whirl_system(s)).empty());
  s.rotor.modal->gyroscopic = {1.0};
  const std::vector<double> speeds = critical_speeds(whirl_system(s));
  ASSERT_EQ(speeds.size(), 1u);
  EXPECT_NEAR(speeds[0], std::sqrt(2e5 / (2.0 - 1.0)), 1e-6);
}

// Omega = omega (1 + d_e / d_i).
TEST(StabilityThreshold, Jeffcott) {
  for (double external : {0.0, 5.0, 40.0}) {
    scene::Scene s = jeffcott(2.0, 2e5, external);
    s.rotor.modal->internal_damping = {10.0};
    const WhirlSystem system = whirl_system(s);
    const std::optional<double> threshold = stability_threshold(system);
    ASSERT_TRUE(threshold);
    const double exact = std::sqrt(1e5) * (1.0 + external / 10.0);
    EXPECT_NEAR(*threshold / exact, 1.0, kTight);
    // Forward whirl grows beyond, and nothing before.
    EXPECT_GT(whirl_spectrum(system, 0.99 * exact).modes[1].damping_ratio, 0.0);
    const WhirlSpectrum beyond = whirl_spectrum(system, 1.01 * exact);
    EXPECT_LT(beyond.modes[1].damping_ratio, 0.0);
    EXPECT_GT(beyond.modes[1].frequency, 0.0);
    EXPECT_GT(beyond.modes[0].damping_ratio, 0.0);
  }
}

// With internal damping alone whirl grows as soon as the spin is faster than it: the threshold is
// the first critical speed, found by another equation.
TEST(StabilityThreshold, InternalDampingAloneIsTheCriticalSpeed) {
  scene::Scene s = scene_of(oracle::friswell_rotor());
  s.rotor.geometry->internal_damping_ratio = 0.002;
  const WhirlSystem system = whirl_system(s);
  EXPECT_NEAR(*stability_threshold(system) / critical_speeds(system).front(), 1.0, kTight);
}

TEST(StabilityThreshold, NoneWithoutInternalDamping) {
  scene::Scene s = scene_of(oracle::friswell_rotor());
  EXPECT_FALSE(stability_threshold(whirl_system(s))) << "undamped";
  s.rotor.geometry->damping_ratio = 0.01;
  EXPECT_FALSE(stability_threshold(whirl_system(s)));
  EXPECT_FALSE(stability_threshold(whirl_system(jeffcott(2.0, 0.0, 0.0)))) << "free body";
}

double least_damping(const WhirlSystem& system, double speed) {
  double least = 1.0;
  for (const WhirlMode& mode : whirl_spectrum(system, speed).modes)
    least = std::min(least, mode.damping_ratio);
  return least;
}

// The reference rig with cross-coupling about one speed of a bearing's table.
scene::Scene with_window(double at, double width, double cross) {
  scene::Scene s = test::reference_rig();
  s.rotor.geometry->damping_ratio = 1e-4;
  scene::ShaftBearing& bearing = s.rotor.geometry->bearings[0];
  bearing.table_speed = {0.0, at - width, at, at + width, at + 3000.0};
  bearing.table_kxx = bearing.table_kyy = {2e7, 2e7, 2e7, 2e7, 2e7};
  bearing.table_kxy = {0.0, 0.0, cross, 0.0, 0.0};
  bearing.table_kyx = {0.0, 0.0, -cross, 0.0, 0.0};
  bearing.stiffness = {2e7, 2e7};
  return s;
}

// The limits of a window of instability that is narrower than any even step are found.
TEST(StabilityThreshold, FindsTheWindowsOfATable) {
  for (const double at : {137.0, 420.0, 811.0, 1723.0, 2950.0}) {
    const double width = 0.02 * at;
    const WhirlSystem system = whirl_system(with_window(at, width, 5e6));
    const auto grows = [&](double speed) { return least_damping(system, speed) < 0.0; };
    ASSERT_TRUE(grows(at)) << at;
    ASSERT_FALSE(grows(at - width));
    const std::vector<UnstableRange> ranges = unstable_ranges(system);
    ASSERT_EQ(ranges.size(), 1U) << at;
    const auto [from, to] = ranges[0];
    EXPECT_EQ(stability_threshold(system), from);
    EXPECT_GT(from, at - width);
    EXPECT_LT(from, at);
    EXPECT_GT(to, at);
    EXPECT_LT(to, at + width);
    EXPECT_TRUE(grows(from * (1.0 + 1e-7)) && grows(to * (1.0 - 1e-7)));
    EXPECT_FALSE(grows(from * (1.0 - 1e-7)) || grows(to * (1.0 + 1e-7)));
  }
  EXPECT_FALSE(stability_threshold(whirl_system(with_window(420.0, 8.0, 1e3))))
      << "too weak a cross-coupling";
}

// A rotor of unit mass is stable while c omega > k: between two points of the table k is below c
// omega, at each of them it is not.
TEST(StabilityThreshold, FindsAWindowBetweenTwoPointsOfATable) {
  WhirlSystem system = whirl_system(jeffcott(1.0, 1e5, 2.0));
  const std::vector<double> speed{0.0, 300.0, 330.0, 360.0, 2000.0};
  std::array<std::vector<double>, 8> values;
  values[4] = values[7] = {0.0, 0.0, 60.0, 120.0, 120.0};
  values[1] = {0.0, 0.0, 19000.0, 19000.0, 19000.0};
  values[2] = {0.0, 0.0, -19000.0, -19000.0, -19000.0};
  WhirlFilm film;
  film.station = Eigen::VectorXd::Ones(1);
  film.law.table = std::make_shared<CoefficientTable>(speed, values);
  system.films.push_back(film);
  for (const double at : speed) ASSERT_GT(least_damping(system, at), 0.0) << at;
  std::optional<double> by_hand;
  for (double at = 300.0; at < 330.0 && !by_hand; at += 0.01) {
    if (least_damping(system, at) < 0.0) by_hand = at;
  }
  const std::optional<double> found = stability_threshold(system);
  ASSERT_TRUE(found && by_hand);
  EXPECT_NEAR(*found, *by_hand, 0.01);
}

// Cross-coupling makes the forward whirl of the first mode grow at all speeds. Its gyroscopic
// moment lifts its frequency beyond that of the second mode, so that it is no longer among the
// modes kept.
TEST(StabilityThreshold, AGrowingWhirlIsFollowedBeyondTheModesKept) {
  WhirlSystem system;
  const Eigen::Vector2d stiffness(1e4, 1e6), damping(0.0, 50.0), gyroscopic(1.5, 0.0);
  system.stiffness_x = system.stiffness_y = stiffness.asDiagonal();
  system.damping_x = system.damping_y = damping.asDiagonal();
  system.gyroscopic = gyroscopic.asDiagonal();
  system.internal_xx = system.internal_xy = system.internal_yy = Eigen::Matrix2d::Zero();
  system.films.push_back({Eigen::Vector2d(1.0, 0.0), {{0.0, 500.0, -500.0, 0.0}, nullptr}});
  system.kept = 1;
  system.isotropic = true;
  const WhirlSpectrum beyond = whirl_spectrum(system, 2000.0);
  EXPECT_NEAR(beyond.modes.back().frequency, 1000.0, 1.0) << "the growing whirl is faster";
  const std::vector<UnstableRange> ranges = unstable_ranges(system);
  ASSERT_EQ(ranges.size(), 1U);
  EXPECT_EQ(ranges[0].from, 0.0);
  EXPECT_TRUE(std::isinf(ranges[0].to)) << ranges[0].to;
}

// In the spin's own sense: a machine and its mirror image, which turns the other way, have one
// threshold.
TEST(StabilityThreshold, OfTheMirrorImageIsTheSame) {
  scene::Scene s = test::anisotropic_rotor();
  s.rotor.geometry->damping_ratio = 0.005;
  s.rotor.geometry->internal_damping_ratio = 0.002;
  scene::ShaftBearing& bearing = s.rotor.geometry->bearings[0];
  bearing.cross_stiffness = {2e4, -1e4};
  const std::optional<double> here = stability_threshold(whirl_system(s));
  bearing.cross_stiffness = {-2e4, 1e4};
  const WhirlSystem mirrored = whirl_system(s);
  const std::optional<double> there = stability_threshold(mirrored, -1.0);
  ASSERT_TRUE(here && there);
  EXPECT_NEAR(*there / *here, 1.0, kTight);
  EXPECT_NE(stability_threshold(mirrored), here);
}

// External damping so large that the threshold lies beyond the search: stated by its bound.
TEST(StabilityThreshold, BeyondTheBound) {
  scene::Scene s = jeffcott(2.0, 2e5, 40.0);
  s.rotor.modal->internal_damping = {1.0};  // 41 omega
  const WhirlSystem system = whirl_system(s);
  EXPECT_FALSE(stability_threshold(system));
  EXPECT_NEAR(stability_bound(system) / (20.0 * std::sqrt(1e5)), 1.0, kTight);
}

}  // namespace
}  // namespace rotorub
