// One impact under `coulomb` with friction that falls with the slip: the figures of
// plugin/README.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

// A free rotor that spins meets a fixed ring at 0.4 m/s after 0.05 mm; the blow takes its slip from
// 1 m/s to 0.3 m/s.
constexpr const char* kFallingBlow = R"(
[run]
end = 1e-3
[rotor]
speed = 20.0
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
inertia = 2e-3
[drive]
kind = "free"
[contact]
radius = 0.05
clearance = 0.5e-3
friction = { static = 0.3, kinetic = 0.1, stribeck_speed = 0.5 }
restitution = 0.5
[initial]
x = [0.45e-3]
vx = [0.4]
)";

class CoulombImpact : public HookedTest {
 protected:
  // rad/s that the blow takes from the spin, in proportion to its friction impulse.
  static double braked(std::vector<std::string> overrides) {
    overrides.push_back("mujoco.contact=coulomb");
    const ModelPointer m = load(mjcf(parsed(kFallingBlow, overrides)));
    const DataPointer d = start(m.get());
    const double begin = d->qvel[m->nv - 1];
    while (d->time < 1e-3) mj_step(m.get(), d.get());
    EXPECT_LT(d->qvel[0], 0.0) << "it has rebounded";
    EXPECT_EQ(sensor(m.get(), d.get(), mjcf_names::kNormalForce), 0.0);
    return begin - d->qvel[m->nv - 1];
  }
  // The largest relative error, for contacts that begin at five places within a step.
  static double error(double step, const std::string& stiffness = {}) {
    const Trajectory exact = run_event(parsed(kFallingBlow));
    const double taken = exact.column("spin_speed").front() - exact.column("spin_speed").back();
    double largest = 0.0;
    for (int place = 0; place < 5; ++place) {
      char start[64], of_step[64];
      std::snprintf(start, sizeof start, "initial.x=[%.12g]", 0.45e-3 + 0.2 * place * 0.4 * step);
      std::snprintf(of_step, sizeof of_step, "run.step=%.12g", step);
      std::vector<std::string> overrides{start, of_step};
      if (!stiffness.empty()) overrides.push_back("mujoco.solref_stiffness=" + stiffness);
      largest = std::max(largest, std::abs(braked(overrides) / taken - 1.0));
    }
    return largest;
  }
};

// As stiff as the step allows, a bounce takes as many steps however short they are.
TEST_F(CoulombImpact, IsOffByTheSameAtEveryStepWithTheDefaultStiffness) {
  for (const double step : {1e-5, 2e-6, 5e-7, 1e-7}) {
    EXPECT_GT(error(step), 0.02) << step;
    EXPECT_LT(error(step), 0.03) << step;
  }
}

TEST_F(CoulombImpact, ConvergesWithOneStiffnessForAllSteps) {
  EXPECT_NEAR(error(2e-6, "1e10"), 0.026, 5e-4);
  EXPECT_NEAR(error(5e-7, "1e10"), 0.0073, 5e-4);
  EXPECT_NEAR(error(1e-7, "1e10"), 0.001, 5e-4);
}

}  // namespace
}  // namespace rotorub::test
