// Contact model `coulomb`: its bounce, and its behaviour inside MuJoCo (rubs: exact_rub_test.cc).
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

namespace names = mjcf_names;

using CoulombContact = HookedTest;

// The bounce of the scene's restitution, without a load: MuJoCo's law makes up for loads while it
// pushes, so one that presses on the contact costs some of the rebound, a / (v sqrt K).
TEST_F(CoulombContact, BouncesByTheRestitution) {
  const scene::Scene scene =
      shipped("bench_billiard", {"mujoco.contact=coulomb", "mujoco.solref_stiffness=1e6",
                                 "run.step=2e-6", "contact.restitution=0.5", "initial.vy=[0.0]"});
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  for (int k = 0; k < 30000 && d->qvel[0] > 0.0; ++k) mj_step(m.get(), d.get());
  for (int k = 0; k < 30000 && sensor(m.get(), d.get(), names::kGap) < 0.0; ++k) {
    mj_step(m.get(), d.get());
  }
  EXPECT_NEAR(d->qvel[0], -0.5 * 0.3, 0.3 * 2e-3);  // sqrt(K) step = 2e-3
}

// MuJoCo raises a friction coefficient of 0 to 1e-5 in its contacts.
TEST_F(CoulombContact, WithoutFrictionThereIsNone) {
  const ModelPointer m = load(mjcf(shipped("bench_billiard", {"mujoco.contact=coulomb"})));
  const DataPointer d = start(m.get());
  int touching = 0;
  for (int k = 0; k < 2000; ++k) {
    mj_step(m.get(), d.get());
    touching += sensor(m.get(), d.get(), names::kNormalForce) > 0.0 ? 1 : 0;
    EXPECT_EQ(sensor(m.get(), d.get(), names::kFrictionForce), 0.0);
  }
  EXPECT_GT(touching, 10);
}

// ---------------------------------------------------------------- impacts
// One impact under `coulomb` with friction that falls with the slip: the figures of
// plugin/README.md.

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

// As stiff as the step allows, a bounce takes the same number of steps for any step.
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

// ---------------------------------------------------------------- cone
// Contact model `cone`: MuJoCo's own contact. How well it does is a finding, not a requirement;
// here it must act on the right bodies in the right direction.

class ConeContact : public HookedTest {
 protected:
  static scene::Scene scene(const std::string& text) {
    return parsed(text, {"mujoco.contact=cone"});
  }
};

TEST_F(ConeContact, FrictionOpposesTheSlipAndKeepsToTheCone) {
  const ModelPointer m = load(mjcf(shipped("bench_ring", {"mujoco.contact=cone"})));
  const DataPointer d = start(m.get());
  int touched = 0;
  for (int k = 0; k < 20000; ++k) {
    mj_step(m.get(), d.get());
    const double normal = sensor(m.get(), d.get(), names::kNormalForce);
    const double friction = sensor(m.get(), d.get(), names::kFrictionForce);
    if (normal == 0.0) continue;
    ++touched;
    EXPECT_LE(friction * sensor(m.get(), d.get(), names::kSlip), 0.0);
    EXPECT_LE(std::abs(friction), 0.15 * normal * (1.0 + 1e-9));
  }
  EXPECT_GT(touched, 0);
}

// A prescribed speed is not a degree of freedom, but its slip r Omega must have an effect.
TEST_F(ConeContact, FeelsThePrescribedSpin) {
  const std::string text = R"(
[run]
end = 0.02
step = 1e-5
[rotor]
speed = "50 Hz"
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
damping = [0.0]
[contact]
radius = 0.05
clearance = "0.5 mm"
friction = 0.2
restitution = 0.0
[initial]
x = [0.4e-3]
vx = [0.1]
)";
  const ModelPointer m = load(mjcf(scene(text)));
  const DataPointer d = start(m.get());
  for (int k = 0; k < 1000 && d->qvel[1] == 0.0; ++k) mj_step(m.get(), d.get());
  // e_t is +y at +x, the surface slips along it, friction pushes the rotor along -y.
  EXPECT_LT(d->qvel[1], 0.0);
}

// MuJoCo's default cone is a pyramid, whose rows are edges and no components: what the sensors say
// is what the contact exchanges. Pressed to a ring that stands, 100 N, slipping.
TEST_F(ConeContact, OfAPyramidTheForcesAreThoseThatAct) {
  const std::string text = R"(
[run]
end = 0.02
step = 1e-5
[rotor]
speed = "0.01 Hz"
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
stiffness_y = [1e8]
damping = [4000.0]
[contact]
radius = 0.05
clearance = "0.5 mm"
friction = 0.2
restitution = 0.0
[[force]]
kind = "constant"
vector = [200.0, 0.0]
[initial]
x = [0.5e-3]
)";
  for (const int cone : {int{mjCONE_PYRAMIDAL}, int{mjCONE_ELLIPTIC}}) {
    const ModelPointer m = load(mjcf(scene(text)));
    m->opt.cone = cone;
    const DataPointer d = start(m.get());
    for (int k = 0; k < 5000; ++k) mj_step(m.get(), d.get());
    mj_forward(m.get(), d.get());
    ASSERT_EQ(d->ncon, 1) << d->qpos[0] << " " << d->qpos[1] << " " << d->qvel[0];
    const double x = d->qpos[0], y = d->qpos[1], delta = std::hypot(x, y);
    const double normal = sensor(m.get(), d.get(), names::kNormalForce);
    const double friction = sensor(m.get(), d.get(), names::kFrictionForce);
    // N e_r - T e_t = (200 N, 0) - k (x, y) - d v - m a.
    const auto rest = [&](int i) { return 4000.0 * d->qvel[i] + 2.0 * d->qacc[i]; };
    const double pull_x = 200.0 - 2e5 * x - rest(0), pull_y = -1e8 * y - rest(1);
    EXPECT_NEAR(normal, (pull_x * x + pull_y * y) / delta, 1e-6);
    EXPECT_NEAR(friction, (pull_x * y - pull_y * x) / delta, 1e-6);
    EXPECT_LT(friction, -0.02 * normal);
    EXPECT_NEAR(normal, 100.0, 20.0);
  }
}

// ---------------------------------------------------------------- starts
// Compliant contacts in MuJoCo that begin closed: loaded and not struck, as natively
// (tests/native_model/event/compliant_start_test.cc), after a keyframe, a reset and a state that a
// program writes.

constexpr double kDepth = 5e-6, kSpeed = 0.05, kClearance = 0.5e-3;
const double kLeaves = std::sqrt(kSpeed * kSpeed + 1e7 * kDepth * kDepth);  // 0.05244 m/s
// The error of MuJoCo's step, of first order: sqrt(k/m) step = 3e-3.
constexpr double kError = 5e-3;

std::string start_text(const std::string& contact, const std::string& start) {
  return R"([run]
end = 2e-3
step = 1e-6
[rotor]
speed = 0.0
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
damping = [0.0]
[contact]
radius = 0.05
clearance = 0.0005
friction = 0.0
restitution = 0.5
[contact.compliance]
stiffness = 2e7
[mujoco]
contact = ")" +
         contact + "\"\n[initial]\n" + start + "\n";
}

class CompliantStart : public HookedTest, public testing::WithParamInterface<const char*> {
 protected:
  // m/s, with which the rotor flies after 1.5 ms; half a period on the spring is 1 ms.
  static double speed_after(const mjModel* m, mjData* d) {
    for (int k = 0; k < 1500; ++k) mj_step(m, d);
    EXPECT_GT(sensor(m, d, mjcf_names::kGap), 0.0);
    return std::hypot(d->qvel[0], d->qvel[1]);
  }
};

TEST_P(CompliantStart, InTheWallItKeepsItsEnergy) {
  const ModelPointer m = load(mjcf(parsed(start_text(GetParam(), "x = [0.000505]\nvx = [0.05]"))));
  const DataPointer d = start(m.get());
  EXPECT_NEAR(speed_after(m.get(), d.get()) / kLeaves, 1.0, kError);
  mj_resetDataKeyframe(m.get(), d.get(), mj_name2id(m.get(), mjOBJ_KEY, "start"));
  EXPECT_NEAR(speed_after(m.get(), d.get()) / kLeaves, 1.0, kError) << "a keyframe";
  for (const double time : {d->time, 7.0}) {  // from flight, with the clock going on, and another
    d->time = time;
    d->qpos[0] = -(kClearance + kDepth);
    d->qpos[1] = 0.0;
    d->qvel[0] = -kSpeed;
    d->qvel[1] = 0.0;
    mj_forward(m.get(), d.get());
    EXPECT_NEAR(speed_after(m.get(), d.get()) / kLeaves, 1.0, kError) << "written at " << time;
  }
  mj_resetData(m.get(), d.get());
  d->qpos[1] = kClearance + kDepth;
  d->qvel[1] = -kSpeed;
  EXPECT_NEAR(speed_after(m.get(), d.get()) / kLeaves, 1.0, kError) << "a reset";
}

// 2 F / k = 30 um under 300 N.
TEST_P(CompliantStart, OnTheCircleAtRestItIsLoaded) {
  const ModelPointer m = load(mjcf(parsed(start_text(
      GetParam(), "x = [0.0005]\n[[force]]\nkind = \"constant\"\nvector = [300.0, 0.0]"))));
  const DataPointer d = start(m.get());
  double deepest = 0.0;
  for (int k = 0; k < 1500; ++k) {
    mj_forward(m.get(), d.get());  // a second pass at the same time changes nothing
    mj_step(m.get(), d.get());
    deepest = std::max(deepest, std::hypot(d->qpos[0], d->qpos[1]) - kClearance);
  }
  EXPECT_NEAR(deepest / 3e-5, 1.0, kError);
}

// A touch from flight has the damping of the restitution.
TEST_P(CompliantStart, FromFlightItIsStruck) {
  const ModelPointer m = load(mjcf(parsed(start_text(GetParam(), "x = [0.00049]\nvx = [0.05]"))));
  const DataPointer d = start(m.get());
  EXPECT_NEAR(speed_after(m.get(), d.get()) / (0.5 * kSpeed), 1.0, 2.0 * kError);
}

INSTANTIATE_TEST_SUITE_P(, CompliantStart, testing::Values("coulomb", "cone-coulomb"),
                         [](const auto& of) {
                           return std::string(of.param) == "coulomb" ? "Coulomb" : "ConeCoulomb";
                         });

}  // namespace
}  // namespace rotorub::test
