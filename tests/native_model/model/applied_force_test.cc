// Forces in time: constant and rotating, on, off and ramp.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "native_model/model/model.h"

namespace rotorub {
namespace {

AppliedForce constant(double on, double off, double ramp) {
  return {scene::ForceKind::kConstant, 0.0, 0.0, 0.0, {4.0, -2.0}, on, off, ramp, {}};
}

TEST(AppliedForce, ActsFromOnToBeforeOff) {
  const AppliedForce f = constant(0.1, 0.3, 0.0);
  const double just = std::numeric_limits<double>::infinity();
  EXPECT_EQ(f.at(std::nextafter(0.1, -just), 0.0), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(f.at(0.1, 0.0), Eigen::Vector2d(4.0, -2.0));
  EXPECT_EQ(f.at(std::nextafter(0.3, -just), 0.0), Eigen::Vector2d(4.0, -2.0));
  EXPECT_EQ(f.at(0.3, 0.0), Eigen::Vector2d(0.0, 0.0));
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
    EXPECT_DOUBLE_EQ(f.at(t, 0.0).x(), 150.0 * std::cos(314.0 * t + 0.5));
    EXPECT_DOUBLE_EQ(f.at(t, 0.0).y(), 150.0 * std::sin(314.0 * t + 0.5));
  }
  // Forward is from x to y; a negative frequency turns backward.
  AppliedForce g = f;
  g.phase = g.on = 0.0;
  EXPECT_GT(g.at(1e-3, 0.0).y(), 0.0);
  g.frequency = -314.0;
  EXPECT_LT(g.at(1e-3, 0.0).y(), 0.0);
}

// Locked to the spin, it is where the spin is; a chirp begins in its phase and its frequency, and
// its angle grows by the mean of both frequencies; a pulse is 0 at both ends.
TEST(AppliedForce, OfTheKindsThatFollowAndPass) {
  AppliedForce f{scene::ForceKind::kSynchronous, 2.0, 0.0, 0.5, {9.0, 9.0}, 0.1, 0.3, 0.0, {}};
  EXPECT_DOUBLE_EQ(f.at(0.2, 4.0).x(), 2.0 * std::cos(4.5));
  EXPECT_DOUBLE_EQ(f.at(0.2, 4.0).y(), 2.0 * std::sin(4.5));
  EXPECT_EQ(f.at(0.3, 4.0), Eigen::Vector2d(0.0, 0.0));
  f.kind = scene::ForceKind::kChirp;
  f.frequency = 100.0;
  f.frequency_end = -20.0;
  EXPECT_DOUBLE_EQ(f.angle(0.1, 4.0), 0.5);
  EXPECT_NEAR((f.angle(0.1 + 1e-6, 4.0) - 0.5) / 1e-6, 100.0, 1e-3);
  EXPECT_NEAR(f.angle(0.3, 4.0), 0.5 + 0.2 * 40.0, 1e-13);
  EXPECT_NEAR((f.angle(0.3, 4.0) - f.angle(0.3 - 1e-6, 4.0)) / 1e-6, -20.0, 1e-3);
  f.kind = scene::ForceKind::kPulse;
  EXPECT_EQ(f.at(0.1, 4.0), Eigen::Vector2d(0.0, 0.0));
  EXPECT_NEAR(f.at(0.2, 4.0).x(), 9.0, 1e-14);
  EXPECT_NEAR(f.at(0.15, 4.0).y(), 9.0 * std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(f.at(std::nextafter(0.3, 0.0), 4.0).y(), 0.0, 1e-13);
}

}  // namespace
}  // namespace rotorub
