// The normal of a step that reaches the ring, of rotor or ring that go round an axis: their path
// bends.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plugin/contact/rigid_step.h"

namespace rotorub::plugin {
namespace {

constexpr double kClearance = 5e-4, kStep = 1e-5;

double angle_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::atan2(std::abs(a.x() * b.y() - a.y() * b.x()), a.dot(b));
}

RigidStep step_of(const Eigen::Vector2d& d, const Eigen::Vector2d& velocity,
                  const Eigen::Vector2d& bend) {
  RigidStep step;
  step.h = kStep;
  step.d = d;
  step.start = step.free = {velocity.x(), velocity.y(), 0.0};
  step.bend = bend;
  return step;
}

// Pressed against the ring by its curve, while its rate opens.
TEST(ContactNormal, OfWhatItsBendClosesIsThatOfTheLineOfCentres) {
  const RigidStep step = step_of({kClearance - 1e-12, 0.0}, {-1e-5, 0.3}, {2e-9, 0.0});
  ASSERT_TRUE(reaches_ring(step, kClearance));
  EXPECT_LT(angle_between(contact_normal(step, kClearance), step.d), 1e-12);
}

// Near the circle, whatever the step and its bend: no further round than the centre travels.
TEST(ContactNormal, IsNoFurtherRoundThanTheArcOfTheStep) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int reached = 0;
  for (int k = 0; k < 200000; ++k) {
    const double speed = std::pow(10.0, 2.0 * unit(random) - 2.0),
                 depth = std::pow(10.0, 4.0 * unit(random) - 10.0);
    const Eigen::Vector2d bend =
        std::pow(10.0, 3.0 * unit(random) - 10.0) * Eigen::Vector2d(unit(random), unit(random));
    const RigidStep step = step_of({kClearance - depth, 0.0},
                                   speed * Eigen::Vector2d(unit(random), unit(random)), bend);
    if (!reaches_ring(step, kClearance)) continue;
    ++reached;
    const double path = (end_of(step) - step.d).norm();
    ASSERT_LE(angle_between(contact_normal(step, kClearance), step.d),
              1.6 * path / kClearance + 1e-9)
        << step.free.transpose() << " bend " << bend.transpose();
  }
  EXPECT_GT(reached, 20000);
}

}  // namespace
}  // namespace rotorub::plugin
