// The contact in a user's own model whose rotor or ring MuJoCo's constraints hold as well:
// equalities, limits, friction loss, tendons, other contacts. A disc of 2 kg flies at 0.3 m/s along
// x against a ring of 1 kg; what it leaves with is computed by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <thread>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "plugin/hooks.h"
#include "plugin/model/user_data.h"
#include "tests/plugin/own/machine.h"
#include "tests/support/mujoco_document.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

constexpr double kStep = 1e-5, kBlow = 0.3, kRotor = 2.0, kRing = 1.0;
// Share of the motion without the constraint that solimp 0.9999 still allows in a step.
constexpr double kSoft = 3e-4;

enum Coordinate { kX, kY, kSpin, kRingX, kRingY, kOther };

class HeldBodies : public MujocoTest {
 protected:
  // The disc, a micrometre off the ring, which it meets in the first step.
  static DataPointer begin(const mjModel* m) {
    DataPointer d = start(m);
    d->qpos[kX] = 4.99e-4;
    d->qvel[kX] = kBlow;
    return d;
  }
  static double gap_rate(const mjData* d) { return d->qvel[kRingX] - d->qvel[kX]; }

  // Gap rate after the step of the blow, relative to the one without the contact.
  static double rebound(const mjModel* m, const std::function<void(mjData*)>& set = {}) {
    const auto after = [&](bool plugin) {
      std::optional<plugin::Hooks> hooks;
      if (plugin) hooks.emplace();
      const DataPointer d = begin(m);
      if (set) set(d.get());
      mj_step(m, d.get());
      return gap_rate(d.get());
    };
    return -after(true) / after(false);
  }

  static DataPointer blow(const mjModel* m, int steps = 1,
                          const std::function<void(mjData*)>& set = {}) {
    const plugin::Hooks hooks;
    DataPointer d = begin(m);
    if (set) set(d.get());
    for (int k = 0; k < steps; ++k) mj_step(m, d.get());
    return d;
  }
};

void move_base(mjData* d) { d->qvel[kOther] = kBlow; }
// A ring that is held acts as a fixed ring: the disc leaves with half of its speed.
TEST_F(HeldBodies, AHeldRingIsAFixedRing) {
  for (const Machine& x :
       {welded(), locked(), pinned(), at_limit(), at_tendon_limit(), tendon_held()}) {
    const ModelPointer m = load(document(x));
    EXPECT_NEAR(rebound(m.get()), kEps, 1e-6) << x.constraints << x.ring_joint;
    const DataPointer d = blow(m.get());
    EXPECT_NEAR(d->qvel[kX], -kEps * kBlow, kSoft * kBlow) << x.constraints << x.ring_joint;
    EXPECT_NEAR(d->qvel[kRingX], 0.0, kSoft * kBlow) << x.constraints << x.ring_joint;
    // The same over the whole blow.
    EXPECT_NEAR(gap_rate(blow(m.get(), 200).get()), kEps * kBlow, 2e-3 * kBlow);
  }
}

// 200 kg and the disc act as one body.
TEST_F(HeldBodies, ARotorTiedToAHeavyBodyStrikesWithIt) {
  const double whole = kRotor + 200.0;
  const double impulse = 1.5 * kBlow / (1.0 / whole + 1.0 / kRing);
  const ModelPointer m = load(document(tied_to(200.0)));
  EXPECT_NEAR(rebound(m.get(), move_base), kEps, 1e-6);
  const DataPointer d = blow(m.get(), 1, move_base);
  EXPECT_NEAR(d->qvel[kX], kBlow - impulse / whole, kSoft * kBlow);
  EXPECT_NEAR(d->qvel[kOther], kBlow - impulse / whole, kSoft * kBlow);
  EXPECT_NEAR(d->qvel[kRingX], impulse / kRing, kSoft * kBlow);
}

// Below its friction loss the ring stands, and the disc on it; above it they move off together.
TEST_F(HeldBodies, FrictionLossHoldsAPressedRing) {
  const ModelPointer m = load(document(rubbing_ring()));
  for (const double force : {30.0, 80.0}) {
    const DataPointer d = blow(m.get(), 5000, [force](mjData* data) {
      data->qpos[kX] = 5e-4;
      data->qvel[kX] = 0.0;
      data->qfrc_applied[kX] = force;
    });
    // MuJoCo's friction loss creeps below its threshold by F R / B: R = 1e-4 / 1 kg, B = 100 / s.
    const double time = 5000 * kStep;
    const double way = force < kLoss ? force * 1e-4 / 100.0 * time
                                     : 0.5 * (force - kLoss) / (kRotor + kRing) * time * time;
    EXPECT_NEAR(d->qpos[kRingX], way, 0.2 * std::min(way, 2e-6) + 1e-3 * way) << force;
    EXPECT_NEAR(d->qpos[kX] - d->qpos[kRingX], 5e-4, 1e-9) << force;
    const double pressed = force < kLoss ? force : kLoss + (force - kLoss) / 3.0;
    EXPECT_NEAR(sensor(m.get(), d.get(), names::kNormalForce), pressed, 1e-3 * force);
  }
}

// Ring and part are pushed off together; the part may fly on, but is not pulled.
TEST_F(HeldBodies, ALoosePartBehindTheRingTakesTheBlow) {
  const ModelPointer m = load(document(loose_part()));
  const double behind = kRing + 3.0;
  const double impulse = 1.5 * kBlow / (1.0 / kRotor + 1.0 / behind);
  const DataPointer d = blow(m.get());
  EXPECT_NEAR(d->qvel[kX], kBlow - impulse / kRotor, kSoft * kBlow);
  EXPECT_NEAR(d->qvel[kRingX], impulse / behind, kSoft * kBlow);
  EXPECT_NEAR(d->qvel[kOther], impulse / behind, kSoft * kBlow);
  // A part that meets the ring in the same step.
  EXPECT_NEAR(rebound(m.get(), [](mjData* data) { data->qvel[kOther] = -1.0; }), kEps, 1e-6);
}

// Friction of the blow: the whole cone against the slip, and at most what stops it.
TEST_F(HeldBodies, FrictionIsOfTheImpulseThatTheHeldRingGives) {
  for (Machine x : {welded(), at_limit(), tendon_held()}) {
    x.friction = 0.15;
    const ModelPointer m = load(document(x));
    const DataPointer slides = blow(m.get(), 1, [](mjData* data) { data->qvel[kSpin] = 100.0; });
    const double impulse = (1.0 + kEps) * kRotor * kBlow;
    const double normal = sensor(m.get(), slides.get(), names::kNormalForce);
    EXPECT_NEAR(normal * kStep, impulse, 2.0 * kSoft * impulse);
    EXPECT_NEAR(sensor(m.get(), slides.get(), names::kFrictionForce), -0.15 * normal,
                1e-6 * normal);
    EXPECT_NEAR(slides->qvel[kSpin], 100.0 - 0.05 * 0.15 * impulse / 1e-3,
                1e-3 * 0.05 * 0.15 * impulse / 1e-3);
    const DataPointer sticks = blow(m.get(), 1, [](mjData* data) { data->qvel[kSpin] = 0.1; });
    const double slip = sticks->qvel[kY] - sticks->qvel[kRingY] + 0.05 * sticks->qvel[kSpin];
    EXPECT_NEAR(slip, 0.0, 1e-7);
  }
}

// Each of MuJoCo's solvers, dense and sparse rows, pyramids and elliptic cones.
TEST_F(HeldBodies, AnySolverIsAsked) {
  for (const char* option :
       {"solver=\"Newton\" jacobian=\"sparse\"", "solver=\"CG\" iterations=\"200\"",
        "solver=\"PGS\" iterations=\"1000\"", "integrator=\"implicit\""}) {
    Machine x = tied_to(200.0);
    x.ring_joint = at_limit().ring_joint;
    x.option = option;
    const ModelPointer m = load(document(x));
    EXPECT_NEAR(rebound(m.get(), move_base), kEps, 1e-4) << option;
  }
}

// Damped joints: MuJoCo's step takes dampers implicitly, the blow is not damped.
TEST_F(HeldBodies, DampersTakeNothingFromABlow) {
  Machine x = welded();
  x.rotor_joint = "damping=\"500\"";
  x.ring_joint = "damping=\"500\"";
  const ModelPointer m = load(document(x));
  EXPECT_NEAR(rebound(m.get()), kEps, 1e-6);
}

TEST_F(HeldBodies, SoftContactStandsBesideConstraintsToo) {
  Machine fixed;
  fixed.contact = "coulomb";
  fixed.friction = 0.15;
  Machine held = fixed;
  held.constraints = locked().constraints;
  fixed.ring_joint = "armature=\"1e9\"";  // too heavy to move
  const auto speeds = [](const Machine& x) {
    const ModelPointer m = load(document(x));
    const DataPointer d = blow(m.get(), 100, [](mjData* data) { data->qvel[kSpin] = 100.0; });
    return std::array<double, 3>{d->qvel[kX], d->qvel[kY], d->qvel[kSpin]};
  };
  const auto a = speeds(fixed), b = speeds(held);
  EXPECT_NEAR(a[0], -0.157, 1e-3);  // 16 steps a blow: not quite 0.5
  // The ring gives way by 1e-4 / kg of the impulse, 0.9 N s.
  EXPECT_NEAR(a[0], b[0], 2.0 * 0.9 * 1e-4);
  EXPECT_NEAR(a[1], b[1], kSoft * kBlow);
  EXPECT_NEAR(a[2], b[2], kSoft * (100.0 - a[2]));
}

// Constraints elsewhere change no bit of a contact that they do not affect.
TEST_F(HeldBodies, ConstraintsElsewhereChangeNoBit) {
  Machine x;
  x.bodies = R"(<body name="lamp" pos="0 0 1"><joint name="lamp" type="slide" axis="0 0 1"/>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body>)";
  const ModelPointer free = load(document(x));
  x.constraints = equality("<joint joint1=\"lamp\"/>");
  const ModelPointer elsewhere = load(document(x));
  EXPECT_EQ(state_of(free.get(), blow(free.get(), 300).get()),
            state_of(elsewhere.get(), blow(elsewhere.get(), 300).get()));
}

// A probe has no lasting effect: forward passes may be repeated, data copied, threads used.
TEST_F(HeldBodies, ProbesLeaveNoTrace) {
  Machine x = loose_part();
  x.friction = 0.15;
  x.ring_joint = rubbing_ring().ring_joint;
  x.constraints = tied_to(20.0).constraints;
  x.bodies += tied_to(20.0).bodies;
  const ModelPointer m = load(document(x));
  const auto press = [](mjData* data) {
    data->qvel[kSpin] = 100.0;
    data->qfrc_applied[kX] = 90.0;
  };
  const DataPointer once = blow(m.get(), 400, press);
  const plugin::Hooks hooks;
  const DataPointer repeated = begin(m.get());
  press(repeated.get());
  for (int k = 0; k < 400; ++k) {
    const std::vector<mjtNum> warm(repeated->qacc_warmstart, repeated->qacc_warmstart + m->nv);
    for (int i = 0; i < 2; ++i) {
      mj_forward(m.get(), repeated.get());
      std::copy(warm.begin(), warm.end(), repeated->qacc_warmstart);  // MuJoCo's own memory
    }
    mj_step(m.get(), repeated.get());
  }
  EXPECT_EQ(state_of(m.get(), once.get()), state_of(m.get(), repeated.get()));

  const DataPointer copy(mj_copyData(nullptr, m.get(), once.get()));
  const auto run = [&](mjData* d) {
    for (int k = 0; k < 400; ++k) mj_step(m.get(), d);
  };
  std::thread other([&] { run(copy.get()); });
  run(once.get());
  other.join();
  EXPECT_EQ(state_of(m.get(), once.get()), state_of(m.get(), copy.get()));
}

// Away from the ring the bits are MuJoCo's, with or without constraints.
TEST_F(HeldBodies, ARotorThatDoesNotTouchHasMujocosBits) {
  for (const Machine& x : {welded(), tied_to(200.0), rubbing_ring(), loose_part()}) {
    const ModelPointer m = load(document(x));
    const auto away = [&](bool plugin) {
      std::optional<plugin::Hooks> hooks;
      if (plugin) hooks.emplace();
      const DataPointer d = start(m.get());
      d->qvel[kX] = 0.1;
      d->qvel[kRingX] = 0.05;
      for (int k = 0; k < 300; ++k) mj_step(m.get(), d.get());
      return state_of(m.get(), d.get());
    };
    EXPECT_EQ(away(true), away(false));
  }
}

// ---------------------------------------------------------------- generated models
// A generated model to which a user has added constraints: the native step of `rigid` does not know
// them, so that the contact is solved as in a model of the user's own.

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

// On segments `rigid` and `coulomb` solve the contact beside the constraint, too.
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
