// A generated model to which a user has added constraints: the native step of `rigid` does not know
// them, so that the contact is solved as in a model of the user's own.
#include <gtest/gtest.h>

#include <cmath>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "plugin/model/user_data.h"
#include "tests/support/mujoco_document.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

using HeldGenerated = HookedTest;

// A disc of 2 kg at 0.3 m/s against a ring of 1 kg, without springs.
const std::string kFlight = R"(
[run]
end = 0.01
step = 1e-5
[rotor]
speed = 20.0
[rotor.modal]
mass = [2.0]
stiffness = [1e-3]
damping = [0.0]
inertia = 1e-3
[contact]
radius = 0.05
clearance = "0.5 mm"
friction = FRICTION
restitution = 0.5
[stator]
mass = 1.0
damping = 0.0
stiffness = 1e-3
[initial]
x = [4.99e-4]
vx = [0.3]
)";

std::string written(const std::string& contact, const std::string& friction) {
  return mjcf(parsed(replaced(kFlight, "FRICTION", friction), {"mujoco.contact=" + contact}));
}

std::string locked(const std::string& document) {
  return replaced(document, "</mujoco>",
                  "<equality><joint joint1=\"ring_x\" solimp=\"0.9999 0.9999 0.001\"/>"
                  "<joint joint1=\"ring_y\" solimp=\"0.9999 0.9999 0.001\"/></equality></mujoco>");
}

DataPointer after(const mjModel* m, int steps) {
  DataPointer d = start(m);
  for (int k = 0; k < steps; ++k) mj_step(m, d.get());
  return d;
}

// Either contact, and friction of a speed that is held: mu (1 + eps) m v along y.
TEST_F(HeldGenerated, ALockedRingIsAFixedRing) {
  for (const char* contact : {"rigid", "coulomb"}) {
    const ModelPointer m = load(locked(written(contact, "0.15")));
    const DataPointer d = after(m.get(), 200);
    const double rebound = -d->qvel[0] / 0.3;
    EXPECT_NEAR(rebound, 0.5, 0.03) << contact;
    EXPECT_NEAR(d->qvel[1], -0.15 * (1.0 + rebound) * 0.3, 2e-3) << contact;
    if (std::string(contact) == "rigid") {
      EXPECT_NEAR(rebound, 0.5, 1e-3);
    }
  }
}

TEST_F(HeldGenerated, ALimitHolds) {
  const ModelPointer m = load(replaced(
      written("rigid", "0.0"), "<joint name=\"ring_x\" ",
      "<joint name=\"ring_x\" limited=\"true\" range=\"-1 -1e-7\" solimplimit=\"0.9999 0.9999 "
      "0.001\" "));
  EXPECT_NEAR(-after(m.get(), 1)->qvel[0] / 0.3, 0.5, 1e-3);
}

// Forces of the scene act in full beside it: with a free ring, held by nothing that acts, the run
// is that of the native step to first order.
TEST_F(HeldGenerated, TheGeneralPathHasTheSceneLoads) {
  const scene::Scene bench = shipped("bench_ring");
  const std::string plain = mjcf(bench);
  const ModelPointer native = load(plain);
  const ModelPointer general = load(replaced(
      plain, "<joint name=\"ring_x\" ", "<joint name=\"ring_x\" limited=\"true\" range=\"-1 1\" "));
  const DataPointer a = after(native.get(), 5000), b = after(general.get(), 5000);
  EXPECT_NEAR(a->qpos[0], b->qpos[0], 1e-5);
  EXPECT_NEAR(a->qpos[1], b->qpos[1], 1e-5);
  EXPECT_NEAR(sensor(native.get(), a.get(), names::kNormalForce),
              sensor(general.get(), b.get(), names::kNormalForce), 1.0);
}

std::string last_warning;

// On segments too the contact is solved beside the constraint, `rigid` and `coulomb`.
TEST_F(HeldGenerated, SegmentsAreSolvedBesideIt) {
  const auto document = [](const std::string& contact) {
    return locked(
        mjcf(shipped("paper_passive",
                     {"mujoco={rotor=\"segments\", segments=20, contact=\"" + contact + "\"}"})));
  };
  mju_user_warning = [](const char* text) { last_warning = text; };
  const auto strike = [](const mjModel* m, int steps) {
    DataPointer d = start(m);
    const int ring = m->jnt_dofadr[mj_name2id(m, mjOBJ_JOINT, names::kRingX)];
    d->qpos[m->jnt_qposadr[mj_name2id(m, mjOBJ_JOINT, names::kEndX)]] = 4.9e-4;
    d->qvel[m->jnt_dofadr[mj_name2id(m, mjOBJ_JOINT, names::kEndX)]] = 3.0;
    for (int k = 0; k < steps && first_contact(d.get()).impact == 0.0; ++k) mj_step(m, d.get());
    EXPECT_NEAR(d->qvel[ring], 0.0, 3e-3);
    return d;
  };
  const ModelPointer rigid = load(document("rigid"));
  const DataPointer d = strike(rigid.get(), 50);
  EXPECT_EQ(last_warning, "");
  EXPECT_NEAR(first_contact(d.get()).gap_rate_after / -first_contact(d.get()).gap_rate_before, 0.5,
              1e-6);
  const ModelPointer coulomb = load(document("coulomb"));
  const DataPointer soft = strike(coulomb.get(), 3);
  EXPECT_EQ(last_warning, "");
  EXPECT_GT(first_contact(soft.get()).normal_force, 0.0);
  const double mu = shipped("paper_passive").first().contact->friction.coefficient;
  EXPECT_NEAR(std::abs(first_contact(soft.get()).friction_force),
              mu * first_contact(soft.get()).normal_force,
              1e-9 * first_contact(soft.get()).normal_force);
}

}  // namespace
}  // namespace rotorub::test
