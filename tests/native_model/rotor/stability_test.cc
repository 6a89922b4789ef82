// Critical speeds and the threshold of stability.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "native_model/rotor/campbell.h"
#include "tests/native_model/rotor/rotors.h"
#include "tests/native_model/rotor/tolerances.h"

namespace rotorub {
namespace {

using test::kBeam;
using test::kTight;
using test::jeffcott;
using test::kShaft;
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

// At a critical speed some whirl is in step with the spin.
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

// A disc with J_p > J_t is never caught up with by its tilting whirl.
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

TEST(StabilityThreshold, ShaftWithoutGyroscopicTerms) {
  scene::Scene s = scene_of(oracle::friswell_rotor());
  s.rotor.geometry->damping_ratio = 0.02;
  s.rotor.geometry->internal_damping_ratio = 0.01;
  WhirlSystem system = whirl_system(s);
  system.gyroscopic.setZero();
  const double first =
      whirl_spectrum(system, 0.0).modes[1].frequency / std::sqrt(1.0 - 0.03 * 0.03);  // undamped
  EXPECT_NEAR(*stability_threshold(system) / (3.0 * first), 1.0, kTight);
}

// With internal damping alone whirl grows as soon as the spin is faster than it: the threshold is
// the first critical speed, found by another equation.
TEST(StabilityThreshold, InternalDampingAloneIsTheCriticalSpeed) {
  scene::Scene s = scene_of(oracle::friswell_rotor());
  s.rotor.geometry->internal_damping_ratio = 0.002;
  const WhirlSystem system = whirl_system(s);
  EXPECT_NEAR(*stability_threshold(system) / critical_speeds(system).front(), 1.0, kTight);
}

TEST(StabilityThresholdLong, AnisotropyStabilises) {
  scene::Scene s = scene_of(oracle::friswell_rotor());
  s.rotor.geometry->internal_damping_ratio = 0.002;
  const double isotropic = *stability_threshold(whirl_system(s));
  s.rotor.geometry->bearings[0].stiffness =
      s.rotor.geometry->bearings[1].stiffness = {1.2e6, 0.8e6};
  EXPECT_GT(*stability_threshold(whirl_system(s)), isotropic);
}

TEST(StabilityThreshold, NoneWithoutInternalDamping) {
  scene::Scene s = scene_of(oracle::friswell_rotor());
  EXPECT_FALSE(stability_threshold(whirl_system(s))) << "undamped";
  s.rotor.geometry->damping_ratio = 0.01;
  EXPECT_FALSE(stability_threshold(whirl_system(s)));
  EXPECT_FALSE(stability_threshold(whirl_system(jeffcott(2.0, 0.0, 0.0)))) << "free body";
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
