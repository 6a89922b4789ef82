// Actuators that add to what a magnetic bearing's amplifier is asked for.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "native_model/numerics/matrix_functions.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

using BearingCurrentsTest = HookedTest;

constexpr const char* kHeld = R"(
[run]
end = 0.01
step = 1e-5
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
[contact]
radius = 0.05
clearance = 0.5e-3
friction = 0.1
restitution = 0.3
[magnetic_bearing]
negative_stiffness = 1e5
[magnetic_bearing.control]
force_per_current = 80.0
proportional = 4000.0
derivative = 2.0
current_limit = 3.0
[magnetic_bearing.amplifier]
bandwidth = 9000.0
[mujoco]
bearing_currents = true
)";

// A step of it is a step of the linear loop's input: x' = A x + b c, x = (r, r', i).
TEST_F(BearingCurrentsTest, AStepIsTheLoopsOwn) {
  constexpr double kAsked = 0.25;
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
  a(0, 1) = 1.0;
  a.row(1) << 1e5 / 2.0, 0.0, 80.0 / 2.0, 0.0;
  a.row(2) << -9000.0 * 4000.0, -9000.0 * 2.0, -9000.0, 9000.0;
  for (const char* contact : {"rigid", "coulomb"}) {
    SCOPED_TRACE(contact);
    const scene::Scene s = scene::parse_scene(
        kHeld, "held.toml", std::vector<std::string>{std::string("mujoco.contact=") + contact});
    const ModelPointer m = load(mjcf(s));
    ASSERT_EQ(m->nu, 2);
    const int y = mj_name2id(m.get(), mjOBJ_ACTUATOR, mjcf_names::bearing_current(0, 1).c_str());
    ASSERT_GE(y, 0);
    EXPECT_EQ(m->actuator_ctrlrange[2 * y + 1], 3.0);
    const DataPointer d = start(m.get());
    const int bend =
        m->jnt_qposadr[mj_name2id(m.get(), mjOBJ_JOINT, mjcf_names::bending_joint('y', 1).c_str())];
    const int coil =
        m->jnt_dofadr[mj_name2id(m.get(), mjOBJ_JOINT, mjcf_names::bearing_integral(1).c_str())];
    d->ctrl[y] = kAsked;
    double most = 0.0;
    for (int k = 1; k <= 800; ++k) {
      mj_step(m.get(), d.get());
      const Eigen::Vector4d x = matrix_exp(a * (k * 1e-5)) * Eigen::Vector4d(0.0, 0.0, 0.0, kAsked);
      most = std::max(most, std::abs(x[0]));
      // MuJoCo's Euler step is of the first order, native steps are of the second.
      EXPECT_NEAR(d->qpos[bend], x[0], contact == std::string("rigid") ? 2e-8 : 1.5e-6) << k;
    }
    EXPECT_GT(most, 5e-5);
    EXPECT_GT(d->qvel[coil], -3.0);
  }
}

// None where no key asks for it, or nothing lags.
TEST_F(BearingCurrentsTest, AreThereWhereAKeyAsks) {
  EXPECT_EQ(
      load(mjcf(scene::parse_scene(kHeld, "held.toml",
                                   std::vector<std::string>{"mujoco.bearing_currents=false"})))
          ->nu,
      0);
  EXPECT_THROW(
      mjcf(scene::parse_scene(kHeld, "held.toml",
                              std::vector<std::string>{"magnetic_bearing.amplifier=none"})),
      scene::SceneError);
}

}  // namespace
}  // namespace rotorub::test
