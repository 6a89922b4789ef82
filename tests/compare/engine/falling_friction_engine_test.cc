// Friction that falls with slip, by the plugin in MuJoCo: the laws are those of the native model.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mjcf/writer.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

using scene::ContactModel;

const std::vector<std::string> kFalling{
    "contact.friction={static=0.3,kinetic=0.1,stribeck_speed=8.0,viscous=0.004}", "run.end=0.1",
    "run.output_step=1e-3"};

// Another normal law, another step: the same law of friction, to the order of the step.
TEST(FallingFrictionInMujoco, CoulombConvergesToTheSame) {
  const scene::Scene s = shipped("bench_ring", kFalling);
  const Trajectory exact = run_event(s);
  const double coarse = rotor_error(mujoco_run(s, ContactModel::kCoulomb, 4e-5), exact);
  const double fine = rotor_error(mujoco_run(s, ContactModel::kCoulomb, 1e-5), exact);
  EXPECT_LT(fine, 0.4 * coarse);
  EXPECT_LT(fine, 3e-5);
}

TEST(FallingFrictionInMujoco, ConeHasOneCoefficient) {
  for (const char* model : {"cone", "cone-coulomb"}) {
    std::vector<std::string> overrides = kFalling;
    overrides.push_back(std::string("mujoco.contact=") + model);
    EXPECT_TRUE(contains(message_of([&] { mjcf(shipped("bench_ring", overrides)); }),
                         R"(mujoco.contact = "rigid" or "coulomb")"));
  }
}

}  // namespace
}  // namespace rotorub::test
