// Whole runs with the segment rotor: a lasting rub has the forces of the native beam.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "compare/engine/mujoco_engine.h"
#include "native_model/run/run_native.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/mujoco_run.h"

namespace rotorub::test {
namespace {

// Of little friction, the rig's rub settles. The modes that the native side keeps are as many as
// matter at its impacts.
scene::Scene rub(int segments, const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = {
      "mujoco={rotor=\"segments\", segments=" + std::to_string(segments) + "}",
      "run.step=5e-6",
      "run.end=0.3",
      "contact.friction=0.1",
      "rotor.modes=5",
      "rotor.torsion.modes=3"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return shipped("paper_passive", overrides);
}

TEST(SegmentRubLong, LastingRubAgreesWithNative) {
  const scene::Scene scene = rub(20);
  const Trajectory native = run_native(scene);
  const auto at_end = [](const Trajectory& t) {
    return Eigen::Vector2d(t.column("rotor_x").back(), t.column("rotor_y").back());
  };
  for (const auto contact : {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb}) {
    const Trajectory t = mujoco_run(scene, contact);
    // 20 segments are 1.2e-3 off in frequency, 7 % in frequency below a resonance.
    EXPECT_NEAR(t.mean_force(), native.mean_force(), 0.02 * native.mean_force());
    EXPECT_LT((at_end(t) - at_end(native)).norm(), 0.02 * at_end(native).norm());
    EXPECT_GT(t.contact_fraction(), 0.9);
  }
}

TEST(SegmentRub, RefusesAStepBeyondItsStiffness) {
  const Trajectory t = run_mujoco(rub(40), mujoco_options(scene::ContactModel::kCoulomb, 1e-5));
  EXPECT_EQ(t.status, Status::kStepTooLarge);
  EXPECT_NE(t.message.find("run.step"), std::string::npos) << t.message;
}

TEST(SegmentRub, SurvivesItsFirstImpacts) {
  scene::Scene scene = rub(20);
  scene.run.end = 0.12;
  const Trajectory t = mujoco_run(scene, scene::ContactModel::kRigid), native = run_native(scene);
  ASSERT_GE(t.impacts.size(), 2u);
  // The free orbit grows for 7.2 ms, at a frequency that is 1.2e-3 off.
  EXPECT_NEAR(t.impacts[0].t, native.impacts[0].t, 5e-5);
  // Every impact takes energy.
  for (const Impact& impact : t.impacts) EXPECT_LE(impact.energy_change, 1e-12);
  EXPECT_GT(t.contact_fraction(), 0.5);
}

// The ring stands off the line: the segments meet it when the beam does, which is another time.
TEST(SegmentRub, MeetsARingOffTheLineWhereItIs) {
  const double centred = run_native(rub(20, {"run.end=0.11"})).impacts.at(0).t;
  for (const char* offset :
       {"contact.offset=[2.2e-4,-1.1e-4]", "contact.offset=[-2.2e-4,1.1e-4]"}) {
    const scene::Scene scene = rub(20, {"run.end=0.11", offset});
    const double native = run_native(scene).impacts.at(0).t;
    EXPECT_GT(std::abs(native - centred), 3e-4) << offset;
    EXPECT_NEAR(mujoco_run(scene, scene::ContactModel::kRigid).impacts.at(0).t, native, 5e-5)
        << offset;
  }
}

}  // namespace
}  // namespace rotorub::test
