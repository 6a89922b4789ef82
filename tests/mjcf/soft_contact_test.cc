#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "mjcf/soft_contact.h"
#include "tests/support/jeffcott.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

// Bisection and the closed form's own round-off.
constexpr double kRoundOff = 1e-12;
// The contact starts somewhere within a step: the bounce is met to about sqrt(K) step.
constexpr double kMujocoBounce = 3e-4;

TEST(SoftContact, ElasticWithoutDamping) { EXPECT_DOUBLE_EQ(soft_restitution(0.0), 1.0); }

TEST(SoftContact, CriticalDampingLeavesExpMinusTwo) {
  EXPECT_NEAR(soft_restitution(1.0), std::exp(-2.0), kRoundOff);
  // Both branches meet there.
  EXPECT_NEAR(soft_restitution(1.0 - 2e-6), soft_restitution(1.0), 1e-6);
  EXPECT_NEAR(soft_restitution(1.0 + 2e-6), soft_restitution(1.0), 1e-6);
}

TEST(SoftContact, StronglyOverdampedAsKnown) { EXPECT_NEAR(soft_restitution(10.0), 0.0024, 5e-5); }

TEST(SoftContact, FallsWithDamping) {
  for (double zeta = 0.0; zeta < 8.0; zeta += 0.01) {
    EXPECT_GT(soft_restitution(zeta), soft_restitution(zeta + 0.01)) << zeta;
  }
}

TEST(SoftContact, DampingRatioInvertsRestitution) {
  for (double e = 0.01; e < 1.0; e += 0.01) {
    EXPECT_NEAR(soft_restitution(soft_damping_ratio(e)), e, kRoundOff) << e;
  }
  EXPECT_EQ(soft_damping_ratio(1.0), 0.0);
  EXPECT_EQ(soft_damping_ratio(0.0), kMaxDampingRatio);
}

TEST(SoftContact, DefaultIsAsStiffAsTheStepAllows) {
  const SoftContact c = soft_contact(0.5, 1e-5);
  EXPECT_NEAR(std::sqrt(c.stiffness) * 1e-5, kContactStepFraction, kRoundOff);
  EXPECT_NEAR(c.damping / (2.0 * std::sqrt(c.stiffness)), soft_damping_ratio(0.5), kRoundOff);
  // A plastic contact must not turn the velocity round within a step.
  const SoftContact plastic = soft_contact(0.0, 1e-5);
  EXPECT_LE(plastic.damping * 1e-5, 1.0 + kRoundOff);
  EXPECT_DOUBLE_EQ(soft_contact(0.5, 1e-5, 1e8).stiffness, 1e8);
}

TEST(SoftContact, OfAConeKnowsTheSpeedOfEveryMode) {
  scene::Scene s = test::make_scene({.mass = 2.0, .stiffness = 2e5, .restitution = 0.5});
  const auto stiffness = [&](std::vector<double> vx) {
    s.initial.vx = std::move(vx);
    return soft_contact(s, scene::ContactModel::kCone, 1e-5).stiffness;
  };
  const double slow = stiffness({0.001}), fast = stiffness({0.02});
  EXPECT_GT(fast, slow);
  EXPECT_EQ(stiffness({0.0, 0.02}), fast);
}

class SoftContactInMujoco : public MujocoTest, public ::testing::WithParamInterface<double> {};

// A sphere on a plane, MuJoCo's own contact: the closed form is MuJoCo's.
TEST_P(SoftContactInMujoco, BouncesAsCalibrated) {
  const double e = GetParam(), step = 1e-6, stiffness = 1e6;
  const SoftContact c = soft_contact(e, step, stiffness);
  const ModelPointer m = load(
      "<mujoco><option timestep=\"1e-6\" gravity=\"0 0 0\"/>"
      "<worldbody><geom name=\"floor\" type=\"plane\" size=\"1 1 1\"/>"
      "<body pos=\"0 0 0.1\"><joint type=\"slide\" axis=\"0 0 1\"/>"
      "<geom name=\"ball\" type=\"sphere\" size=\"0.1\" mass=\"2\"/></body></worldbody>"
      "<contact><pair geom1=\"floor\" geom2=\"ball\" condim=\"1\" solref=\"" +
      std::to_string(-c.stiffness) + " " + std::to_string(-c.damping) +
      "\" solimp=\"0.9999 0.9999 0.001\"/></contact></mujoco>");
  const DataPointer d = start(m.get());
  d->qpos[0] = 0.5e-6;
  d->qvel[0] = -1.0;
  int steps = 0;
  while ((d->qpos[0] < 0.0 || d->qvel[0] < 0.0) && ++steps < 100000) mj_step(m.get(), d.get());
  ASSERT_LT(steps, 100000);
  EXPECT_NEAR(d->qvel[0], e, kMujocoBounce);
}

INSTANTIATE_TEST_SUITE_P(Restitutions, SoftContactInMujoco,
                         ::testing::Values(0.05, 0.2, 0.5, 0.8, 1.0));

// ----------------------------------------------------------------
// The <pair> of each contact model, in the terms of either MuJoCo: before 3.9 seen below margin and
// solved below margin - gap, since then seen below margin + gap and solved below margin.

constexpr double kClearance = 5e-4, kMu = 0.3;
constexpr MujocoVersion kOld{2, 2, 2}, kLastOld{3, 8, 1}, kNew{3, 9, 0};

struct Reach {
  double seen, solved;  // m
};
Reach reach(const ContactPair& pair, const MujocoVersion& version) {
  if (version < kNew) return {pair.margin, pair.margin - pair.gap};
  return {pair.margin + pair.gap, pair.margin};
}

TEST(ContactPair, MeansTheSameInEveryMujoco) {
  const SoftContact soft{4e8, 1e4, 0.9999};
  for (const auto model :
       {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb, scene::ContactModel::kCone}) {
    for (const MujocoVersion& version : {kOld, kLastOld, kNew}) {
      const ContactPair pair = contact_pair(model, kClearance, kMu, soft, version);
      const Reach r = reach(pair, version);
      const bool rigid = model == scene::ContactModel::kRigid,
                 cone = model == scene::ContactModel::kCone;
      EXPECT_EQ(pair.condim, cone ? 3 : 1);
      EXPECT_EQ(pair.friction, kMu);
      EXPECT_EQ(pair.soft.stiffness, 4e8);
      // margin - 1e3 m and back.
      EXPECT_NEAR(r.seen, cone ? 0.0 : (rigid ? 1e-2 : 1e-3) * kClearance, 1e-12);
      if (rigid) {
        EXPECT_LT(r.solved, -100.0) << "no depth brings it into MuJoCo's solver";
      } else {
        EXPECT_EQ(r.solved, r.seen);
        EXPECT_EQ(pair.gap, 0.0);
      }
    }
  }
}

TEST(ContactPair, AConeWithoutFrictionHasNoTangents) {
  EXPECT_EQ(contact_pair(scene::ContactModel::kCone, kClearance, 0.0, {}, kOld).condim, 1);
}

}  // namespace
}  // namespace rotorub::test
