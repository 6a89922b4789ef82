// Whole runs with the segment rotor. (Its lasting rub: tests/compare/evidence.)
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "compare/engine/mujoco_engine.h"
#include "native_model/run/run_native.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/native_run.h"

namespace rotorub::test {
namespace {

// With little friction the rig's rub settles. The native model keeps as many modes as matter at its
// impacts.
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

TEST(SegmentRub, RefusesAStepBeyondItsStiffness) {
  const Trajectory t = run_mujoco(rub(40), mujoco_options(scene::ContactModel::kCoulomb, 1e-5));
  EXPECT_EQ(t.status, Status::kStepTooLarge);
  EXPECT_NE(t.message.find("run.step"), std::string::npos) << t.message;
}

// The ring is off the line: the segments and the beam meet it at different times.
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
