// Forces that follow the spin, sweep, strike and begin as a blade is lost, a motor under speed
// control, and the steady start, in MuJoCo against `event`: `rigid` with the square of the step,
// the models with MuJoCo's own step, the shadow and the segment rotor to what those keep.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "native_model/scene/diagnostic.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/order.h"
#include "tests/support/refusal.h"

namespace rotorub::test {
namespace {

Trajectory event(const scene::Scene& scene) {
  Trajectory t = run_event(scene);
  EXPECT_EQ(t.status, Status::kOk) << t.message;
  return t;
}

// The reference rig with two modes; its magnetic bearing's force begins, or its base moves, as
// `force` says.
scene::Scene rig(const std::string& force, std::vector<std::string> more = {}) {
  std::vector<std::string> all{
      "rotor.modes=2", "run.end=0.04", "run.output_step=1e-3",
      force.starts_with("base=") ? force : "force[0]={" + force + ",station=0.42}"};
  all.insert(all.end(), more.begin(), more.end());
  return shipped("paper_passive", all);
}

const std::string kLocked = "kind='synchronous',amplitude=150.0,phase=0.4,on=1.2345e-3";
const std::string kChirp =
    "kind='chirp',amplitude=180.0,frequency='20 Hz',frequency_end='90 "
    "Hz',phase=0.4,on=1.2345e-3,off=0.0312345";
const std::string kPulse = "kind='pulse',vector=[1500.0,800.0],on=1.2345e-3,off=6.5432e-3";
const std::string kBlade = "kind='unbalance',static_moment=2e-3,phase=0.4,on=1.2345e-3";
// The base moves in addition to the scene's own force.
const std::string kQuake =
    "base={time=[0.0,3.21e-3,9.87e-3,0.0211],acceleration_x=[0.0,180.0,-90.0,10.0],"
    "acceleration_y=[5.0,-70.0,95.0,-20.0],ramp=2e-3}";

class Excitations : public ::testing::TestWithParam<std::string> {};

// MuJoCo's own step, `coulomb`, without a touch: of order 1, less the scatter of a switch within a
// step.
TEST_P(Excitations, MujocosOwnStepFollowsEvent) {
  const scene::Scene scene = rig(GetParam(), {"contact.clearance=0.05", "run.end=0.03"});
  const Trajectory exact = event(scene);
  const Convergence c = convergence({4e-5, 2e-5, 1e-5, 5e-6, 2.5e-6, 1e-6}, [&](double step) {
    return rotor_error(mujoco_run(scene, scene::ContactModel::kCoulomb, step), exact);
  });
  EXPECT_LT(c.errors.front(), 0.02 * largest_size(exact, "rotor_x")) << c.text();
  EXPECT_GT(c.order(), 0.7) << c.text();
}

INSTANTIATE_TEST_SUITE_P(Kinds, Excitations,
                         ::testing::Values(kLocked, kChirp, kPulse, kBlade, kQuake));

// The chain of rigid segments, spin held: to what the segments leave of the shaft's frequencies.
TEST(ExcitationSegments, FollowTheNativeBeam) {
  for (const std::string& force : {kLocked, kChirp, kPulse, kBlade, kQuake}) {
    const scene::Scene scene =
        rig(force, {"drive=none", "rotor.torsion=none", "contact.clearance=0.05", "run.step=5e-6",
                    "mujoco={rotor=\"segments\", segments=16}"});
    const Trajectory exact = event(scene);
    const Trajectory t = mujoco_run(scene, scene::ContactModel::kCoulomb, 5e-6);
    const double size = largest_size(exact, "rotor_x");
    EXPECT_GT(size, 1e-4) << force;
    EXPECT_LT(rotor_error(t, exact), 0.03 * size) << force;
  }
}

TEST(ExcitationSegments, WithADriveABladeIsRefused) {
  const auto refused = refusals([] { rig(kBlade, {"mujoco={rotor=\"segments\", segments=16}"}); });
  ASSERT_FALSE(refused.empty());
  EXPECT_EQ(refused.front().key, "force[0].kind");
}

// ---------------------------------------------------------------- speed control
TEST(SpeedControlEngine, RunsUpAsTheNativeMotor) {
  const std::vector<std::string> drive{"rotor.speed='10 Hz'",
                                       "drive={kind='speed_controlled',gain=0.3,integral_gain=4.0,"
                                       "speed='30 Hz',acceleration='800 Hz/s',"
                                       "torque_limit=15.0,inertia=2e-3,station=0.0}"};
  const scene::Scene scene = rig(kLocked, drive);
  const Trajectory exact = event(scene);
  const Trajectory rigid = mujoco_run(scene, scene::ContactModel::kRigid, 5e-6);
  for (std::size_t k = 0; k < exact.rows(); ++k) {
    EXPECT_NEAR(rigid.column("spin_speed")[k], exact.column("spin_speed")[k], 2e-3) << k;
    EXPECT_NEAR(rigid.column("motor_torque")[k], exact.column("motor_torque")[k], 2e-3) << k;
  }
  EXPECT_GT(largest_size(exact, "motor_torque"), 5.0);
  std::vector<std::string> cut = drive;
  cut.insert(cut.end(), {"mujoco={rotor=\"segments\", segments=12}", "rotor.torsion.modes=3"});
  const scene::Scene segments = rig(kLocked, cut);
  const Trajectory t = mujoco_run(segments, scene::ContactModel::kCoulomb, 5e-6);
  EXPECT_NEAR(t.column("spin_speed").back(), exact.column("spin_speed").back(), 0.5);
}

// ---------------------------------------------------------------- steady start
// The rig as it runs before its magnetic bearing comes on, held at its speed: radius and speed of
// the orbit stay.
double unrest(const scene::Scene& scene, const Trajectory& t) {
  const double period = 1.0 / 50.0;
  double most = 0.0, size = 0.0;
  const auto& time = t.column("t");
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const auto back = static_cast<std::size_t>(std::lround(period / *scene.run.output_step));
    size = std::max(size, std::hypot(t.column("rotor_x")[k], t.column("rotor_y")[k]));
    if (time[k] < period - 1e-9) continue;
    for (const char* name : {"rotor_x", "rotor_y"}) {
      most = std::max(most, std::abs(t.column(name)[k] - t.column(name)[k - back]));
    }
  }
  EXPECT_GT(size, 2e-5);
  return most / size;
}

TEST(SteadyStartEngine, HoldsInMujoco) {
  const std::vector<std::string> more{"drive=none",      "rotor.torsion=none",
                                      "run.end=0.1",     "run.output_step=1e-3",
                                      "force[0].on=1.0", "gravity={acceleration=[0.0,-9.81]}"};
  const scene::Scene scene = shipped("paper_passive", more);
  EXPECT_LT(unrest(scene, mujoco_run(scene, scene::ContactModel::kRigid, 1e-5)), 2e-3);
  EXPECT_LT(unrest(scene, mujoco_run(scene, scene::ContactModel::kCoulomb, 1e-5)), 1e-2);
  // From rest the same rotor is far from steady.
  const scene::Scene rest =
      shipped("paper_passive", {"drive=none", "rotor.torsion=none", "run.end=0.1",
                                "run.output_step=1e-3", "force[0].on=1.0", "initial.steady=false"});
  EXPECT_GT(unrest(rest, mujoco_run(rest, scene::ContactModel::kRigid, 1e-5)), 0.3);
}

}  // namespace
}  // namespace rotorub::test
