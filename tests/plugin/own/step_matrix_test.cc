// MuJoCo's step takes more terms implicitly in the velocities than the joints' dampers: an impact
// must still have its restitution, at any step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "mjcf/writer.h"
#include "tests/plugin/own/machine.h"
#include "tests/plugin/own/two_rings.h"
#include "tests/plugin/scenes.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

class StepMatrix : public HookedTest {
 protected:
  // The closing rate of ring and rotor after the step of the first impact along x, relative to the
  // rate without a contact.
  static double rebound(mjModel* m, double step, int rotor, int ring) {
    m->opt.timestep = step;
    const DataPointer d = start(m), without = start(m);
    d->qpos[rotor] = 4.99e-4;
    d->qvel[rotor] = 0.3;
    const auto rate = [&](const mjData* of) { return of->qvel[ring] - of->qvel[rotor]; };
    for (int k = 0; k * step < 0.02; ++k) {
      mj_copyData(without.get(), m, d.get());
      m->opt.disableflags |= mjDSBL_CONTACT;
      mj_step(m, without.get());
      m->opt.disableflags &= ~mjDSBL_CONTACT;
      mj_step(m, d.get());
      if (rate(d.get()) > 0.0) return -rate(d.get()) / rate(without.get());
    }
    ADD_FAILURE() << "no blow";
    return 0.0;
  }

  static ModelPointer stepped(const std::string& text, const char* integrator) {
    return load(replaced(text, "timestep=\"1e-5\"",
                         "timestep=\"1e-5\" integrator=\"" + std::string(integrator) + "\""));
  }

  static std::string with_actuator(const std::string& actuator) {
    Machine x;
    x.constraints = "<actuator>" + actuator + "</actuator>";
    return document(x);
  }
};

TEST_F(StepMatrix, ABlowHasItsRestitution) {
  const std::string ring_servo = with_actuator(R"(<velocity joint="ring_x" kv="2e4"/>)");
  Machine tendon, fluid, damper;
  tendon.constraints = R"(<tendon><fixed damping="5e3"><joint joint="ring_x" coef="1"/>
                          <joint joint="ring_y" coef="0.5"/></fixed></tendon>)";
  fluid.option = "viscosity=\"5e3\"";
  damper.ring_joint = "damping=\"2e4\"";
  std::vector<std::pair<const char*, std::string>> cases{
      {"implicit", ring_servo},
      {"implicit",
       with_actuator(R"(<general joint="rotor_x" biastype="affine" biasprm="0 0 -2e4"/>)")},
      {"implicit", document(tendon)},
      {"implicit", document(fluid)},
      {"implicit", document(damper)}};
#if mjVERSION_HEADER >= 233
  cases.emplace_back("implicitfast", ring_servo);
  cases.emplace_back("implicitfast", with_actuator(R"(<velocity joint="rotor_x" kv="2e4"/>)"));
#endif
#if mjVERSION_HEADER >= 3007000
  // Dampers may be polynomials, and actuators.
  damper.ring_joint = "damping=\"2e3 1e5 1e6\"";
  const std::string actuator =
      with_actuator(R"(<motor joint="ring_x" gear="2" damping="2e4 1e3 0"/>)");
  cases.emplace_back("Euler", document(damper));
  cases.emplace_back("implicit", document(damper));
  cases.emplace_back("Euler", actuator);
  cases.emplace_back("implicitfast", actuator);
#endif
  for (const auto& [integrator, text] : cases) {
    const ModelPointer m = stepped(text, integrator);
    for (const double step : {1e-5, 1e-4})
      EXPECT_NEAR(rebound(m.get(), step, 0, 3), kEps, 1e-9) << integrator << step << text;
  }
}

// A shaft that turns fast about an axis that is none of its principal ones, in fixed rings: the
// bias forces' derivative is not symmetric.
TEST_F(StepMatrix, ABlowOfAGyroscopeHasItsRestitution) {
  const ModelPointer m = stepped(document(TwoRings{.rings = 1}), "implicit");
  m->opt.timestep = 1e-4;
  const DataPointer d = start(m.get());
  d->qpos[0] = 4e-4;
  d->qvel[0] = 0.3;
  d->qvel[2] = 2.0;  // tilts
  d->qvel[4] = 3000.0;
  double before = 0.0;
  for (int k = 0; k < 10 && d->qvel[0] > 0.0; ++k) {
    before = d->qvel[0];
    mj_step(m.get(), d.get());
  }
  EXPECT_NEAR(d->qvel[0], -kEps * before, 1e-6);
}

// With passive forces disabled MuJoCo's derivative has no dampers.
TEST_F(StepMatrix, ABlowWithoutDampersHasItsRestitution) {
  Machine x;
  x.ring_joint = "damping=\"2e4\"";
  const ModelPointer m = stepped(document(x), "implicit");
#if mjVERSION_HEADER >= 336
  m->opt.disableflags |= mjDSBL_SPRING | mjDSBL_DAMPER;
#else
  m->opt.disableflags |= mjDSBL_PASSIVE;
#endif
  EXPECT_NEAR(rebound(m.get(), 1e-4, 0, 3), kEps, 1e-9);
}

// A lasting contact is held too: pressed with 500 N, beside a servo that pulls the ring away.
TEST_F(StepMatrix, ARubBesideAServoIsHeld) {
  for (const double step : {1e-5, 1e-4}) {
    const ModelPointer m =
        stepped(with_actuator(R"(<velocity name="servo" joint="ring_x" kv="2e4"/>)"), "implicit");
    m->opt.timestep = step;
    const DataPointer d = start(m.get());
    d->qpos[0] = 5e-4;
    double deepest = 0.0;
    for (int k = 0; k * step < 0.02; ++k) {
      d->qfrc_applied[0] = 500.0;
      mj_step(m.get(), d.get());
      const double apart = std::hypot(d->qpos[0] - d->qpos[3], d->qpos[1] - d->qpos[4]);
      deepest = std::max(deepest, apart - 5e-4);
    }
    EXPECT_LT(deepest, 1e-9) << step;
    // Only the servo's drag holds the ring back: 500 N = kv v.
    EXPECT_NEAR(d->qvel[3], 0.025, 1e-4) << step;
  }
}

// A generated model with a servo of the user's on its ring, on both kinds of rotor.
const std::string kServoScene = R"(
[run]
end = 0.02
step = 1e-5
[rotor]
speed = 0.0
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
damping = [0.0]
[contact]
radius = 0.05
clearance = "0.5 mm"
friction = 0.2
restitution = 0.5
[stator]
mass = 0.5
damping = 0.0
stiffness = 0.0
[mujoco]
integrator = "implicit"
[initial]
x = [0.4e-3]
vx = [0.3]
)";

TEST_F(StepMatrix, AServoOnAGeneratedRingLeavesTheRestitution) {
  const std::string servo =
      R"(<actuator><velocity name="servo" joint="ring_x" kv="2e4"/></actuator><sensor>)";
  const ModelPointer m = load(replaced(mjcf(parsed(kServoScene)), "<sensor>", servo));
  const int rotor = m->jnt_dofadr[mj_name2id(m.get(), mjOBJ_JOINT, "x_1")];
  const int ring = m->jnt_dofadr[mj_name2id(m.get(), mjOBJ_JOINT, "ring_x")];
  for (const double step : {1e-5, 1e-4})
    EXPECT_NEAR(rebound(m.get(), step, rotor, ring), kEps, 1e-9) << step;
}

TEST_F(StepMatrix, AServoBesideAConstraintLeavesTheRestitution) {
  Machine x = tied_to(200.0);
  x.constraints += R"(<actuator><velocity name="servo" joint="ring_x" kv="2e4"/></actuator>)";
  const ModelPointer m = stepped(document(x), "implicit");
  EXPECT_NEAR(rebound(m.get(), 1e-4, 0, 3), kEps, 1e-4);
}

TEST_F(StepMatrix, AServoOnTheRingOfASegmentRotorLeavesTheRestitution) {
  const std::string servo =
      R"(<actuator><velocity name="servo" joint="ring_x" kv="2e4"/></actuator><sensor>)";
  const scene::Scene scene =
      parsed(kSegmentRub, {"contact.friction=0.0", "mujoco.integrator=\"implicit\"",
                           "stator.stiffness=0.0", "stator.damping=0.0"});
  const ModelPointer m = load(replaced(mjcf(scene), "<sensor>", servo));
  const DataPointer d = start(m.get()), without = start(m.get());
  // Closing rate after a step, from the sensor in the next.
  const auto rate = [&](mjData* of) {
    mj_step(m.get(), of);
    mj_forward(m.get(), of);
    return sensor(m.get(), of, "gap_rate");
  };
  for (int k = 0; k < 2000; ++k) {
    mj_copyData(without.get(), m.get(), d.get());
    m->opt.disableflags |= mjDSBL_CONTACT;
    const double free = rate(without.get());
    m->opt.disableflags &= ~mjDSBL_CONTACT;
    const double after = rate(d.get());
    if (free < 0.0 && after > 0.0) {
      EXPECT_NEAR(after / free, -kEps, 1e-5);
      return;
    }
  }
  FAIL() << "no blow";
}

// ---------------------------------------------------------------- solver
// MuJoCo's solver is stopped before its end in a step with one of our contacts.

int solver_warnings = 0;
std::string last_solver_warning;
void count_solver_warning(const char* text) {
  ++solver_warnings;
  last_solver_warning = text;
}

class SolverLimit : public HookedTest {
 protected:
  SolverLimit() {
    mju_user_warning = count_solver_warning;
    solver_warnings = 0;
  }
  // Pressed into its ring, the ring held by friction loss: PGS takes the two rows in turns.
  static int warnings(const std::string& option) {
    Machine x;
    x.contact = "cone";
    x.friction = 0.3;
    x.option = "cone=\"elliptic\" " + option;
    x.ring_joint = "frictionloss=\"1000\" solimpfriction=\"0.9999 0.9999 0.001\"";
    const ModelPointer m = load(
        replaced(replaced(document(x), "condim=\"1\"", "condim=\"3\" friction=\"0.3 0.3 0 0 0\""),
                 "margin=\"5e-7\"", ""));
    const DataPointer d = start(m.get());
    d->qpos[0] = 5e-4;
    d->qvel[2] = 50.0;
    solver_warnings = 0;
    for (int k = 0; k < 100; ++k) {
      d->qfrc_applied[0] = 100.0;
      mj_step(m.get(), d.get());
    }
    return solver_warnings;
  }
};

TEST_F(SolverLimit, IsSaidOnce) {
  EXPECT_EQ(warnings("solver=\"PGS\" iterations=\"3\""), 1);
  EXPECT_NE(last_solver_warning.find("solver stopped at iterations=\"3\""), std::string::npos)
      << last_solver_warning;
  EXPECT_EQ(warnings("solver=\"Newton\" iterations=\"100\""), 0) << last_solver_warning;
}

}  // namespace
}  // namespace rotorub::test
