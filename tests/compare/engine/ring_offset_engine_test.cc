// A ring off the line, in MuJoCo: moving the machine with its ring changes nothing, with every
// contact model.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "native_model/scene/reader.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/thrown.h"

namespace rotorub::test {
namespace {

TEST(RingOffsetEngine, AMachineMovedIsTheSameMachine) {
  const std::vector<std::string> plain = {"run.end=0.02",
                                          "stator={mass=1.0,stiffness=1e5,damping=100.0}"};
  std::vector<std::string> moved = plain;
  moved.insert(moved.end(),
               {"contact.offset=[2.5e-4,-1.25e-4]", "initial.x=[2.5e-4]", "initial.y=[-1.25e-4]"});
  const scene::Scene there = scene::parse_scene(kThrown, "thrown.toml", moved);
  const scene::Scene here = scene::parse_scene(kThrown, "thrown.toml", plain);
  for (const auto contact :
       {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb, scene::ContactModel::kCone}) {
    const Trajectory a = mujoco_run(there, contact, 1e-5), b = mujoco_run(here, contact, 1e-5);
    ASSERT_EQ(a.status, Status::kOk) << a.message;
    EXPECT_FALSE(b.impacts.empty());
    EXPECT_EQ(a.impacts.size(), b.impacts.size());
    for (std::size_t k = 0; k < a.rows(); ++k) {
      EXPECT_NEAR(a.column("rotor_x")[k] - 2.5e-4, b.column("rotor_x")[k], 1e-10) << k;
      EXPECT_NEAR(a.column("stator_y")[k] + 1.25e-4, b.column("stator_y")[k], 1e-10) << k;
      EXPECT_NEAR(a.column("gap")[k], b.column("gap")[k], 1e-10) << k;
    }
  }
}

}  // namespace
}  // namespace rotorub::test
