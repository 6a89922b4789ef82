// A rotor that tilts in its ring. The contact is that of its centre's circle: exact for a thin disc
// to first order in the tilt. What is left out, by looking at the rotor's edge point by point.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "plugin/contact/rigid_step.h"
#include "tests/plugin/own/machine.h"
#include "tests/plugin/own/two_rings.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

constexpr double kTiltRadius = 0.05, kTiltClearance = 5e-4;

class Tilt : public HookedTest {
 protected:
  // Gap of a rotor's two edges, `half` to either side of its centre, in an endless cylinder: the
  // least distance of any of their points.
  static double gap_of_edges(const mjModel* m, const mjData* d, double half) {
    const int disc = mj_name2id(m, mjOBJ_GEOM, "disc");
    const mjtNum *centre = d->geom_xpos + 3 * disc, *axes = d->geom_xmat + 9 * disc;
    constexpr int kPoints = 100000;
    double farthest = 0.0;
    for (const double z : {-half, half}) {
      for (int i = 0; i < kPoints; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kPoints;
        const double p[] = {kTiltRadius * std::cos(angle), kTiltRadius * std::sin(angle), z};
        double at[2];
        for (int k = 0; k < 2; ++k) {
          at[k] = centre[k] + axes[3 * k] * p[0] + axes[3 * k + 1] * p[1] + axes[3 * k + 2] * p[2];
        }
        farthest = std::max(farthest, std::hypot(at[0], at[1]));
      }
    }
    return kTiltRadius + kTiltClearance - farthest;
  }
};

// Thin: our gap is the smaller, by no more than r theta^2 / 2 (25 nm at 1 mrad, 2.5 um at 10 mrad).
// Long: the edges come nearer by half the length times theta. Two contacts, one at each end, know
// that.
TEST_F(Tilt, LeavesOutTheSquareOfTheTilt) {
  TwoRings x;
  x.rings = 1;
  const ModelPointer m = load(document(x));
  double most = 0.0;
  for (const double theta : {1e-4, 1e-3, 3e-3, 1e-2}) {
    for (const double direction : {0.0, 0.7, 1.5707963}) {
      const DataPointer d = start(m.get());
      d->qpos[0] = 4e-4;
      d->qpos[2] = theta * std::cos(direction);
      d->qpos[3] = theta * std::sin(direction);
      mj_forward(m.get(), d.get());
      const double ours = kTiltClearance - 4e-4;
      const double missing = gap_of_edges(m.get(), d.get(), 0.0) - ours;
      EXPECT_GT(missing, -1e-12);
      EXPECT_LT(missing, 0.5 * kTiltRadius * theta * theta + 1e-12) << theta;
      most = std::max(most, missing / (0.5 * kTiltRadius * theta * theta));
      const double long_one = ours - gap_of_edges(m.get(), d.get(), 0.01);
      EXPECT_LT(long_one, 0.01 * theta + 1e-12);
      if (direction > 1.5) {
        EXPECT_GT(long_one, 0.8 * 0.01 * theta - 0.5 * kTiltRadius * theta * theta);
      }
    }
  }
  EXPECT_GT(most, 0.3);  // the bound is no more than three times what there is
}

// ---------------------------------------------------------------- normal
// The normal of a step that reaches the ring, of rotor or ring that go round an axis: their path
// bends.
using plugin::contact_normal;
using plugin::end_of;
using plugin::reaches_ring;
using plugin::RigidStep;

constexpr double kNormalClearance = 5e-4, kNormalStep = 1e-5;

double angle_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::atan2(std::abs(a.x() * b.y() - a.y() * b.x()), a.dot(b));
}

RigidStep step_of(const Eigen::Vector2d& d, const Eigen::Vector2d& velocity,
                  const Eigen::Vector2d& bend) {
  RigidStep step;
  step.h = kNormalStep;
  step.d = d;
  step.start = step.free = {velocity.x(), velocity.y(), 0.0};
  step.bend = bend;
  return step;
}

// Pressed against the ring by its curve, while its rate opens.
TEST(ContactNormal, OfWhatItsBendClosesIsThatOfTheLineOfCentres) {
  const RigidStep step = step_of({kNormalClearance - 1e-12, 0.0}, {-1e-5, 0.3}, {2e-9, 0.0});
  ASSERT_TRUE(reaches_ring(step, kNormalClearance));
  EXPECT_LT(angle_between(contact_normal(step, kNormalClearance), step.d), 1e-12);
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
    const RigidStep step = step_of({kNormalClearance - depth, 0.0},
                                   speed * Eigen::Vector2d(unit(random), unit(random)), bend);
    if (!reaches_ring(step, kNormalClearance)) continue;
    ++reached;
    const double path = (end_of(step) - step.d).norm();
    ASSERT_LE(angle_between(contact_normal(step, kNormalClearance), step.d),
              1.6 * path / kNormalClearance + 1e-9)
        << step.free.transpose() << " bend " << bend.transpose();
  }
  EXPECT_GT(reached, 20000);
}

// ---------------------------------------------------------------- guided rotors
// A user's rotor that its joints guide otherwise than by two slides and a hinge through its centre.

constexpr double kClearance = 5e-4;

class GuidedRotor : public HookedTest {
 protected:
  enum { kX, kSpin };
  // In a ring that stands still, with or without a spin.
  static std::string on_one_slide(const std::string& contact, double friction,
                                  const std::string& spin = "") {
    Machine x;
    x.contact = contact;
    x.friction = friction;
    x.ring_moves = false;
    const std::string text =
        replaced(document(x), R"(<joint name="rotor_y" type="slide" axis="0 1 0"/>)", "");
    return replaced(text, R"(<joint name="spin" type="hinge" axis="0 0 1" />)", spin);
  }
};

// Nothing there can slip: G_TT = 0.
TEST_F(GuidedRotor, ARotorOnOneSlideHasItsNormalForce) {
  for (const char* contact : {"rigid", "coulomb"}) {
    const ModelPointer m = load(on_one_slide(contact, 0.15));
    const DataPointer d = start(m.get());
    d->qvel[kX] = 0.3;
    d->qpos[kX] = 4.99e-4;
    for (int k = 0; k < 60; ++k) mj_step(m.get(), d.get());
    EXPECT_NEAR(d->qvel[kX], -0.15, contact[0] == 'r' ? 1e-12 : 0.01) << contact;
    for (int k = 0; k < 20000; ++k) {
      d->qfrc_applied[kX] = 40.0;
      mj_step(m.get(), d.get());
      ASSERT_TRUE(std::isfinite(d->qpos[kX])) << contact << k;
    }
    EXPECT_NEAR(sensor(m.get(), d.get(), "normal_force"), 40.0, 0.01) << contact;
  }
}

// The disc's centre 10 um off its axis, at 1000 rad/s: held at the ring, the shaft goes to and fro
// by x = delta_0 - e cos(phi), which takes N = F - m x''.
TEST_F(GuidedRotor, ACentreThatGoesRoundIsFollowed) {
  for (const char* contact : {"rigid", "coulomb"}) {
    const std::string text =
        replaced(on_one_slide(contact, 0.0,
                              R"(<joint name="spin" type="hinge" axis="0 0 1" armature="100"/>)"),
                 "size=\"0.05 0.01\"", "size=\"0.05 0.01\" pos=\"1e-5 0 0\"");
    const ModelPointer m = load(text);
    const DataPointer d = start(m.get());
    constexpr double kOff = 1e-5, kSpeed = 1000.0, kForce = 100.0, kMass = 2.0;
    d->qpos[kX] = kClearance - kOff;
    d->qvel[kSpin] = kSpeed;
    d->qfrc_applied[kX] = kForce;
    double worst = 0.0;
    for (int k = 0; k < 3000; ++k) {
      const double phi = d->qpos[kSpin];
      mj_step(m.get(), d.get());
      if (k < 500) continue;
      const double x =
          kOff * kSpeed * kSpeed * (std::cos(phi) - kOff / kClearance * std::cos(2.0 * phi));
      worst =
          std::max(worst, std::abs(sensor(m.get(), d.get(), "normal_force") - kForce + kMass * x));
    }
    EXPECT_LT(worst, 0.5) << contact;
  }
}

}  // namespace
}  // namespace rotorub::test
