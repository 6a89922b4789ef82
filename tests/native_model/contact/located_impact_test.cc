#include "native_model/contact/located_impact.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rotorub {
namespace {

constexpr double kCircle = 0.5e-3;  // m

// A whirl whose bounces have become so low that the step's chord begins a trifle outside: it leads
// in, and comes out within the step. It was taken for a flight, and the rotor went on outside, with
// an impact every few steps for ever instead of lasting contact.
TEST(LocatedImpact, AChordThatBeginsOutsideIsNoFlight) {
  FlightStep s;
  s.h = 5e-7;
  s.d = {kCircle + 1.9e-12, 0.0};
  s.velocity = {-3.737e-5, 0.28, 0.0};
  s.acceleration = {180.0, 0.0, 0.0};
  s.admittance = Eigen::Vector3d(1.0, 1.0, 1.0).asDiagonal();
  s.clearance = kCircle;
  s.radius = 0.02;
  ASSERT_GT((s.d + s.h * s.velocity.head<2>()).norm(), kCircle);
  const StepImpacts found = locate_impacts(s, {0.0, 0.4, 0.0});
  EXPECT_TRUE(found.closes || found.count > 0);
  // Without ever coming inside: lasting contact brings it back.
  s.d.x() = kCircle + 1e-10;
  const StepImpacts beside = locate_impacts(s, {0.0, 0.4, 0.0});
  EXPECT_EQ(beside.count, 0);
  EXPECT_TRUE(beside.closes);
}

}  // namespace
}  // namespace rotorub
