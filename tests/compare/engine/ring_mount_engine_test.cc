// Rings on housings, balls, films and dry friction, in MuJoCo: the plugin adds the laws that
// MuJoCo's joints lack, to the order of the step.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/mujoco_run.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"

namespace rotorub::test {
namespace {

using scene::ContactModel;

const std::vector<std::string> kMounted{
    "stator.mount={mass=2.5,stiffness=[3e5,4e5],damping=[60.0,90.0]}",
    "stator.dry_friction={force=12.0,presliding=4e-5}",
    "stator.squeeze_film={radius=0.06,length=0.012,clearance=3e-3,viscosity=0.4}",
    "stator.ball_bearing={balls=9,stiffness=4e8,play=0.05e-3,phase=0.2}",
    "stator.spin={inertia=2e-4,dry_drag=0.05,load_factor=2e-3,pitch_diameter=0.08}",
    "run.end=0.08",
    "run.output_step=1e-3"};

// MuJoCo's own step uses the force of each instant.
TEST(RingMountInMujoco, CoulombConvergesToTheSame) {
  const scene::Scene s = shipped("bench_ring", kMounted);
  const Trajectory exact = run_event(s);
  ASSERT_EQ(exact.status, Status::kOk) << exact.message;
  const double coarse = trajectory_error(mujoco_run(s, ContactModel::kCoulomb, 2e-5), exact, 0.05);
  const double fine = trajectory_error(mujoco_run(s, ContactModel::kCoulomb, 5e-6), exact);
  EXPECT_LT(fine, 0.5 * coarse);
  EXPECT_LT(fine, 1e-4);
}

}  // namespace
}  // namespace rotorub::test
