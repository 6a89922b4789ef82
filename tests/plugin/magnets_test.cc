// The magnetic actuator as MuJoCo's actuators: ctrl is a current, the force is F(s, i).
#include "plugin/model/control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "native_model/bearing/actuator.h"
#include "native_model/numerics/matrix_functions.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "plugin/hooks.h"
#include "tests/support/mujoco_document.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

using BearingCurrentsTest = HookedTest;

// As in paper_magnetic.
const Electromagnet kLaw({416.7e-6, 3.0, 5e-3, 0.0});
constexpr double kLimit = 3.0;  // A

using MagnetsTest = HookedTest;

// Without a controller ctrl belongs to the user.
scene::Scene by_hand(const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides{"controller=none", "rotor.modes=2"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return shipped("paper_magnetic", overrides);
}

int dof(const mjModel* m, const char* joint) {
  return m->jnt_dofadr[mj_name2id(m, mjOBJ_JOINT, joint)];
}

TEST_F(MagnetsTest, ForceIsTheLawOfPlaceAndCurrent) {
  const ModelPointer m = load(mjcf(by_hand()));
  ASSERT_EQ(m->nu, 2);
  ASSERT_EQ(m->na, 0);
  const DataPointer d = start(m.get());
  const int x = dof(m.get(), mjcf_names::kRingX), y = dof(m.get(), mjcf_names::kRingY);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const double h = std::sqrt(0.5);
  for (int k = 0; k < 200; ++k) {
    d->qpos[x] = 3e-3 * unit(random);
    d->qpos[y] = 3e-3 * unit(random);
    for (int axis = 0; axis < 2; ++axis) d->ctrl[axis] = 3.0 * unit(random);
    mj_forward(m.get(), d.get());
    const double s[2] = {h * (d->qpos[x] + d->qpos[y]), h * (d->qpos[y] - d->qpos[x])};
    for (int axis = 0; axis < 2; ++axis) {
      const double force = kLaw.force(s[axis], d->ctrl[axis]);
      EXPECT_NEAR(d->actuator_force[axis], force, 1e-11 * (1e3 + std::abs(force)));
    }
    const double f1 = d->actuator_force[0], f2 = d->actuator_force[1];
    EXPECT_NEAR(d->qfrc_actuator[x], h * (f1 - f2), 1e-9);
    EXPECT_NEAR(d->qfrc_actuator[y], h * (f1 + f2), 1e-9);
    const int id = mj_name2id(m.get(), mjOBJ_SENSOR, mjcf_names::kCurrent);
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_EQ(d->sensordata[m->sensor_adr[id] + axis], d->ctrl[axis]);
    }
  }
}

TEST_F(MagnetsTest, CurrentIsClampedToItsLimit) {
  const ModelPointer m = load(mjcf(by_hand()));
  const DataPointer d = start(m.get());
  d->ctrl[0] = 50.0;
  d->ctrl[1] = -50.0;
  mj_forward(m.get(), d.get());
  EXPECT_NEAR(d->actuator_force[0], kLaw.force(0.0, kLimit), 1e-9);
  EXPECT_NEAR(d->actuator_force[1], kLaw.force(0.0, -kLimit), 1e-9);
}

// MuJoCo steps activations by Euler: i_k = I (1 - (1 - h/lag)^k).
TEST_F(MagnetsTest, CoilFollowsWithItsLag) {
  const ModelPointer m = load(mjcf(by_hand({"actuator.coil_lag=1e-3"})));
  ASSERT_EQ(m->na, 2);
  const DataPointer d = start(m.get());
  d->ctrl[0] = 2.0;
  for (int k = 0; k < 100; ++k) mj_step(m.get(), d.get());
  EXPECT_NEAR(d->act[0], 2.0 * (1.0 - std::pow(1.0 - 1e-2, 100)), 1e-12);
  EXPECT_EQ(d->act[1], 0.0);
  mj_forward(m.get(), d.get());
  EXPECT_NEAR(d->actuator_force[0], kLaw.force(d->actuator_length[0], d->act[0]), 1e-9);
}

TEST_F(MagnetsTest, RateOfTheCurrentIsLimited) {
  const ModelPointer m =
      load(mjcf(by_hand({"actuator.coil_lag=1e-3", "actuator.current_rate_limit=500"})));
  const DataPointer d = start(m.get());
  d->ctrl[0] = 2.0;
  mj_step(m.get(), d.get());
  EXPECT_NEAR(d->act[0], 500.0 * 1e-5, 1e-12) << "2000 A/s without the limit";
  for (int k = 1; k < 2000; ++k) mj_step(m.get(), d.get());
  EXPECT_NEAR(d->act[0], 2.0, 1e-6);
}

TEST_F(MagnetsTest, EditedActuatorsAreRefused) {
  const std::string document = mjcf(by_hand());
  EXPECT_TRUE(contains(load_refusal(replaced(document, "gaintype=\"user\"", "gaintype=\"fixed\"")),
                       {"<general name=\"actuator_1\">", "gaintype=\"user\""}));
  expect_refused(replaced(document, "name=\"actuator_2\"", "name=\"other\""), "actuator_2");
}

mjtNum seven(const mjModel*, const mjData*, int) { return 7.0; }

// A foreign user actuator, in one of our models and in another.
TEST(MagnetHooks, OthersKeepTheirCallbacks) {
  const char* const kOther = R"(<mujoco><worldbody><body><joint name="a" type="slide"/>
    <geom size="0.1"/></body></worldbody>
    <actuator><general joint="a" gaintype="user" biastype="user"/></actuator></mujoco>)";
  const auto force = [&](double ctrl) {
    const ModelPointer m = load(kOther);
    const DataPointer d = start(m.get());
    d->ctrl[0] = ctrl;
    mj_forward(m.get(), d.get());
    return d->actuator_force[0];
  };
  const double plain = force(2.0);
  {
    const plugin::Hooks hooks;
    EXPECT_EQ(force(2.0), plain) << "as MuJoCo without any callback";
  }
  mjcb_act_gain = seven;
  mjcb_act_bias = seven;
  {
    const plugin::Hooks hooks;
    EXPECT_EQ(force(2.0), 21.0);
    const ModelPointer m = load(mjcf(by_hand()));
    const DataPointer d = start(m.get());
    mj_forward(m.get(), d.get());
    EXPECT_EQ(d->actuator_force[0], 0.0) << "ours is ours";
  }
  EXPECT_EQ(mjcb_act_gain, &seven);
  EXPECT_EQ(mjcb_act_bias, &seven);
  mjcb_act_gain = mjcb_act_bias = nullptr;
}

// ---------------------------------------------------------------- currents
// Actuators that add to the requested current of a magnetic bearing's amplifier.

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
      // MuJoCo's Euler step is of first order, native steps are of second.
      EXPECT_NEAR(d->qpos[bend], x[0], contact == std::string("rigid") ? 2e-8 : 1.5e-6) << k;
    }
    EXPECT_GT(most, 5e-5);
    EXPECT_GT(d->qvel[coil], -3.0);
  }
}

// There are none if no key requests them, or if no coil lags.
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
