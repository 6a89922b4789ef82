// The <pair> of each contact model, in the terms of either MuJoCo: before 3.9 seen below margin and
// solved below margin - gap, since then seen below margin + gap and solved below margin.
#include "mjcf/soft_contact.h"

#include <gtest/gtest.h>

namespace rotorub {
namespace {

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
}  // namespace rotorub
