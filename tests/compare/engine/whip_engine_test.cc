// The backward whip in MuJoCo: `rigid` and `coulomb` stay near the exact one, the cone falls into
// the rolling attractor that is there as well.
#include <gtest/gtest.h>

#include "compare/engine/mujoco_engine.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/whip.h"

namespace rotorub::test {
namespace {

Trajectory whip(scene::ContactModel contact, double end) {
  scene::Scene scene = shipped("bench_whip");
  scene.run.end = end;
  return mujoco_run(scene, contact, 1e-5);
}

// After 1 s, at 10 us: -501.845 rad/s and 244.738 N instead of -501.9257 and 244.8444.
TEST(WhipEngine, RigidAndCoulombStayNearTheExactOne) {
  for (const scene::ContactModel contact :
       {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb}) {
    const Trajectory t = whip(contact, 1.0);
    ASSERT_EQ(t.status, Status::kOk) << t.message;
    EXPECT_NEAR(whirl_speed(t, t.rows() - 1), -501.9257, 2e-4 * 502.0) << t.contact_model;
    EXPECT_NEAR(t.column("normal_force").back(), 244.8444, 5e-4 * 245.0) << t.contact_model;
    EXPECT_GT(t.contact_fraction(), 1.0 - 1e-9) << t.contact_model;
  }
}

TEST(WhipEngine, TheConeFallsIntoTheRollingAttractor) {
  const Trajectory t = whip(scene::ContactModel::kCone, 0.05);
  ASSERT_EQ(t.status, Status::kOk) << t.message;
  EXPECT_LT(whirl_speed(t, t.rows() - 1), -1e4);
  EXPECT_GT(t.column("normal_force").back(), 1e5);
}

}  // namespace
}  // namespace rotorub::test
