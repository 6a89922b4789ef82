// A ring off the line, in MuJoCo: a machine moved with its ring is the same machine, by every contact model.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "native_model/scene/reader.h"
#include "tests/support/mujoco_run.h"

namespace rotorub::test {
namespace {

constexpr const char* kThrownInRing = R"(
[run]
end = 0.02
step = 1e-5
output_step = 1e-3
[rotor]
speed = 200.0
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
inertia = 2e-3
[contact]
radius = 0.02
clearance = 0.5e-3
friction = 0.2
restitution = 0.6
[stator]
mass = 1.0
damping = 100.0
stiffness = 1e5
[initial]
vx = [0.1]
vy = [0.04]
)";

TEST(RingOffsetEngine, AMachineMovedIsTheSameMachine) {
  const std::vector<std::string> moved = {"contact.offset=[2.5e-4,-1.25e-4]", "initial.x=[2.5e-4]",
                                          "initial.y=[-1.25e-4]"};
  const scene::Scene there = scene::parse_scene(kThrownInRing, "thrown.toml", moved);
  const scene::Scene here = scene::parse_scene(kThrownInRing, "thrown.toml");
  for (const auto contact : {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb, scene::ContactModel::kCone}) {
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
