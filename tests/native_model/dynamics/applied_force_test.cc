// Forces in time: constant and rotating, on, off and ramp, and the station's mode values.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "native_model/system/actuation.h"
#include "native_model/dynamics/dynamics.h"
#include "tests/support/jeffcott.h"

namespace rotorub {
namespace {

AppliedForce constant(double on, double off, double ramp) {
  return {scene::ForceKind::kConstant, 0.0, 0.0, 0.0, {4.0, -2.0}, on, off, ramp, {}};
}

TEST(AppliedForce, ActsFromOnToBeforeOff) {
  const AppliedForce f = constant(0.1, 0.3, 0.0);
  const double just = std::numeric_limits<double>::infinity();
  EXPECT_EQ(f.at(std::nextafter(0.1, -just)), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(f.at(0.1), Eigen::Vector2d(4.0, -2.0));
  EXPECT_EQ(f.at(std::nextafter(0.3, -just)), Eigen::Vector2d(4.0, -2.0));
  EXPECT_EQ(f.at(0.3), Eigen::Vector2d(0.0, 0.0));
}

TEST(AppliedForce, RampsUpLinearlyAndDropsAtOnce) {
  const AppliedForce f = constant(0.1, 0.5, 0.2);
  EXPECT_EQ(f.envelope(0.1), 0.0);
  EXPECT_NEAR(f.envelope(0.15), 0.25, 1e-15);
  EXPECT_NEAR(f.envelope(0.3), 1.0, 1e-15);
  EXPECT_EQ(f.envelope(0.4999), 1.0);
  EXPECT_EQ(f.envelope(0.5), 0.0);
  // Switched off within the ramp: it never gets there.
  EXPECT_NEAR(constant(0.1, 0.2, 0.4).envelope(0.1999999), 0.25, 1e-6);
}

TEST(AppliedForce, RotatesWithAbsoluteTime) {
  // The angle is frequency t + phase, whatever the switch-on time.
  const AppliedForce f{
      scene::ForceKind::kRotating, 150.0, 314.0, 0.5, {9.0, 9.0}, 0.1, scene::kNever, 0.0, {}};
  for (const double t : {0.1, 0.1234, 0.5}) {
    EXPECT_DOUBLE_EQ(f.at(t).x(), 150.0 * std::cos(314.0 * t + 0.5));
    EXPECT_DOUBLE_EQ(f.at(t).y(), 150.0 * std::sin(314.0 * t + 0.5));
  }
  // Forward is from x to y; a negative frequency turns backward.
  AppliedForce g = f;
  g.phase = g.on = 0.0;
  EXPECT_GT(g.at(1e-3).y(), 0.0);
  g.frequency = -314.0;
  EXPECT_LT(g.at(1e-3).y(), 0.0);
}

TEST(AppliedForce, EntersThroughTheModeValuesOfItsStation) {
  scene::Scene s = test::make_scene({});
  s.rotor.modal->mass = {2.0, 0.8};
  s.rotor.modal->stiffness = s.rotor.modal->damping = {0.0, 0.0};
  test::add_constant_force(s, {10.0, 5.0});
  s.forces[0].shape = {1.0, -0.5};
  test::add_constant_force(s, {1.0, 0.0});  // no shape: 1 throughout
  const Model m = make_model(s);
  Eigen::Vector4d f, none = Eigen::Vector4d::Zero();
  smooth_force(m, 0.0, none.data(), none.data(), {0.0, 0.0}, f.data());
  EXPECT_EQ(f, Eigen::Vector4d(11.0, -4.0, 5.0, -2.5));
}

}  // namespace
}  // namespace rotorub
