// The rest of MuJoCo's interface, called between two steps: functions that observe, compute or copy
// do not change the bits of the following steps, and mj_inverse finds no missing force.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "plugin/differences.h"
#include "plugin/inverse.h"
#include "plugin/model/differentiating.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

// Under a controller that uses velocities, from before the first touch into lasting contact.
scene::Scene controlled(const std::string& rotor, const std::string& contact,
                        const std::string& on = "0.0") {
  return shipped("paper_sliding",
                 {"mujoco={rotor=\"" + rotor + "\", segments=6, contact=\"" + contact + "\"}",
                  "controller.on=" + on, "force[0].on=0.0", "initial.steady=false",
                  "contact.clearance=\"0.1 mm\""});
}

using Look = void (*)(const mjModel*, mjData*);

class Interface : public HookedTest {
 protected:
  static constexpr int kSteps = 900;

  // Commands and final state of a run with a call before some of its steps.
  static std::vector<double> run(const mjModel* m, Look look) {
    const DataPointer d = start(m);
    std::vector<double> all;
    for (int k = 0; k < kSteps; ++k) {
      if (look && k % 3 != 2) {
        // MuJoCo's solver starts from its last solution, on which the last digits of a soft contact
        // depend.
        const std::vector<double> warmstart(d->qacc_warmstart, d->qacc_warmstart + m->nv);
        look(m, d.get());
        mju_copy(d->qacc_warmstart, warmstart.data(), m->nv);
      }
      mj_step(m, d.get());
      all.insert(all.end(), d->ctrl, d->ctrl + m->nu);
    }
    const std::vector<double> state = state_of(m, d.get());
    all.insert(all.end(), state.begin(), state.end());
    return all;
  }
};

void forward(const mjModel* m, mjData* d) { mj_forward(m, d); }
void forward_twice(const mjModel* m, mjData* d) {
  mj_forward(m, d);
  mj_forwardSkip(m, d, mjSTAGE_VEL, 0);
}
void forward_and_inverse(const mjModel* m, mjData* d) {
  mj_forward(m, d);
  mj_inverse(m, d);
}
void own_inverse(const mjModel* m, mjData* d) { plugin::inverse(m, d); }
void first_half(const mjModel* m, mjData* d) { mj_step1(m, d); }
void copy_back(const mjModel* m, mjData* d) {
  const DataPointer kept(mj_copyData(nullptr, m, d));
  for (int k = 0; k < 5; ++k) mj_step(m, d);
  mj_copyData(d, m, kept.get());
}
void write_the_same(const mjModel* m, mjData* d) {
  const std::vector<double> state = state_of(m, d);
  mj_forward(m, d);
  d->qpos[0] = d->qvel[0] = 0.0;
  mju_copy(d->qpos, state.data(), m->nq);
  mju_copy(d->qvel, state.data() + m->nq, m->nv);
}

class Between : public Interface,
                public ::testing::WithParamInterface<std::tuple<const char*, const char*>> {};

TEST_P(Between, CallsChangeNothing) {
  const auto [rotor, contact] = GetParam();
  const ModelPointer m = load(mjcf(controlled(rotor, contact)));
  const std::vector<double> plain = run(m.get(), nullptr);
  int which = 0;
  for (const Look look : {forward, forward_twice, forward_and_inverse, own_inverse, first_half,
                          copy_back, write_the_same}) {
    EXPECT_EQ(run(m.get(), look), plain) << "call " << which;
    ++which;
  }
}

INSTANTIATE_TEST_SUITE_P(Models, Between,
                         ::testing::Combine(::testing::Values("modal", "segments"),
                                            ::testing::Values("rigid", "coulomb", "cone",
                                                              "cone-coulomb")));

// Largest force (N, N m) that inverse dynamics finds missing after a forward pass, besides applied
// and actuators' forces, and the largest force of the contact.
struct Left {
  double force = 0.0, contact = 0.0;
};
Left left_by(const mjModel* m, Look inverse) {
  const DataPointer d = start(m);
  Left out;
  for (int k = 0; k < 3000; ++k) {
    mj_forward(m, d.get());
    const double contact = sensor(m, d.get(), mjcf_names::kNormalForce);
    inverse(m, d.get());
    for (int i = 0; i < m->nv; ++i) {
      const double known = d->qfrc_applied[i] + d->qfrc_actuator[i];
      out.force = std::max(out.force, std::abs(d->qfrc_inverse[i] - known));
    }
    out.contact = std::max(out.contact, contact);
    mj_step(m, d.get());
  }
  return out;
}

TEST_F(Interface, InverseLeavesNothing) {
  for (const char* contact : {"rigid", "coulomb", "cone", "cone-coulomb"}) {
    const ModelPointer m =
        load(mjcf(shipped("bench_ring", {std::string("mujoco.contact=\"") + contact + "\""})));
    const Left ours = left_by(m.get(), own_inverse);
    EXPECT_GT(ours.contact, 50.0);
    // The residual of MuJoCo's solver, as for any soft contact.
    EXPECT_LT(ours.force, 1e-9 * ours.contact) << contact;
  }
}

// The contacts run MuJoCo's solver to correct each other, but qacc is an input here.
TEST_F(Interface, InverseKeepsTheGivenAcceleration) {
  const ModelPointer m = load(
      "<mujoco><option timestep=\"0.001\" cone=\"elliptic\"/><size nuserdata=\"21\"/><worldbody>"
      "<geom name=\"floor\" type=\"plane\" size=\"9 9 1\"/><body pos=\"0 0 0.1\"><freejoint/>"
      "<geom name=\"box\" type=\"box\" size=\".3 .2 .1\" mass=\"1\"/></body></worldbody><contact>"
      "<pair name=\"slide\" geom1=\"floor\" geom2=\"box\" friction=\"0.5 0.5 0 0 0\"/></contact>"
      "<custom><text name=\"rotorub_cone_coulomb_pair\" data=\"slide\"/></custom></mujoco>");
  const DataPointer d = start(m.get());
  for (int k = 0; k < 300; ++k) mj_step(m.get(), d.get());
  d->qvel[0] = 3.0;
  d->qvel[5] = 1.0;
  for (int k = 0; k < 20; ++k) mj_step(m.get(), d.get());
  d->qfrc_applied[1] = 0.3;
  mj_forward(m.get(), d.get());
  ASSERT_EQ(d->ncon, 4);
  const std::vector<mjtNum> given(d->qacc, d->qacc + m->nv);
  own_inverse(m.get(), d.get());
  for (int i = 0; i < m->nv; ++i) {
    EXPECT_EQ(d->qacc[i], given[static_cast<std::size_t>(i)]) << i;
    EXPECT_NEAR(d->qfrc_inverse[i], d->qfrc_applied[i], 1e-6) << i;
  }
}

TEST_F(Interface, DisabledContactIsThatOfARingFarAway) {
  for (const char* rotor : {"modal", "segments"}) {
    const ModelPointer m = load(mjcf(controlled(rotor, "rigid")));
    const DataPointer d = start(m.get());
    for (const int flag : {mjDSBL_CONTACT, mjDSBL_CONSTRAINT}) {
      m->opt.disableflags = flag;
      mj_resetDataKeyframe(m.get(), d.get(), 0);
      double gap = 1.0;
      for (int k = 0; k < 1500; ++k) {
        mj_step(m.get(), d.get());
        EXPECT_EQ(sensor(m.get(), d.get(), mjcf_names::kNormalForce), 0.0);
        EXPECT_EQ(sensor(m.get(), d.get(), mjcf_names::kActive), 0.0);
        gap = std::min(gap, sensor(m.get(), d.get(), mjcf_names::kGap));
      }
      EXPECT_LT(gap, -1e-6) << rotor << ": it must have gone through";
    }
  }
}

// Switched on during the run, and off again: nothing restarts, and a step without a contact is the
// same step.
TEST_F(Interface, ContactMayBeSwitchedWhileItIsOpen) {
  const ModelPointer m = load(mjcf(shipped("bench_ring")));
  const DataPointer plain = start(m.get()), switched = start(m.get());
  for (int k = 0; k < 1500; ++k) {
    mj_step(m.get(), plain.get());
    m->opt.disableflags = k % 2 == 0 && k < 300 ? mjDSBL_CONTACT : 0;  // touches after 406
    mj_step(m.get(), switched.get());
    m->opt.disableflags = 0;
  }
  EXPECT_EQ(state_of(m.get(), switched.get()), state_of(m.get(), plain.get()));
}

TEST_F(Interface, DisabledActuationIsNoForce) {
  const ModelPointer m = load(mjcf(controlled("modal", "rigid")));
  m->opt.disableflags = mjDSBL_ACTUATION;
  const DataPointer d = start(m.get());
  const ModelPointer without = load(mjcf(controlled("modal", "rigid", "1e9")));
  const DataPointer same = start(without.get());
  for (int k = 0; k < 1500; ++k) {
    mj_step(m.get(), d.get());
    mj_step(without.get(), same.get());
  }
  EXPECT_EQ(state_of(m.get(), d.get()), state_of(without.get(), same.get()));
}

std::string last_warning;
void note_error(const char* message) { last_warning = message; }

// The program's own handler may continue; then there is no contact, and the sensor shows it.
TEST_F(Interface, RungeKuttaInMidRunIsRefusedWithAWord) {
  const ModelPointer m = load(mjcf(shipped("bench_ring")));
  const DataPointer d = start(m.get());
  for (int k = 0; k < 100; ++k) mj_step(m.get(), d.get());
  const auto before = mju_user_error;
  mju_user_error = note_error;
  m->opt.integrator = mjINT_RK4;
  mj_step(m.get(), d.get());
  mju_user_error = before;
  EXPECT_TRUE(contains(last_warning, {"RK4", "use Euler, implicit"}));
  EXPECT_EQ(sensor(m.get(), d.get(), mjcf_names::kActive), 0.0);
  m->opt.integrator = mjINT_EULER;
  mj_step(m.get(), d.get());
  EXPECT_EQ(sensor(m.get(), d.get(), mjcf_names::kActive), 1.0);
}

// ---------------------------------------------------------------- differences
// The step linearised: against the closed form of the modal step in flight, and MuJoCo's own
// differences where those hold. (In lasting contact: linear_rub_test.cc.)

class Differences : public HookedTest {
 protected:
  static DataPointer after(const mjModel* m, int steps) {
    DataPointer d = start(m);
    for (int k = 0; k < steps; ++k) mj_step(m, d.get());
    return d;
  }
  static double at(const plugin::Transition& t, int row, int column) {
    return t.A[static_cast<std::size_t>(row * t.states + column)];
  }
  static int dof(const mjModel* m, const std::string& joint) {
    return m->jnt_dofadr[mj_name2id(m, mjOBJ_JOINT, joint.c_str())];
  }
};

// Rotor of bench_ring: v' = ((1 - h d/2m) v - h k/m x) / (1 + h d/2m), x' = x + h v'.
TEST_F(Differences, InFlightTheModalStep) {
  const ModelPointer m = load(mjcf(shipped("bench_ring")));
  const DataPointer d = after(m.get(), 100);
  const std::vector<double> state = state_of(m.get(), d.get());
  const plugin::Transition t = plugin::transition(m.get(), d.get(), 1e-8);
  EXPECT_EQ(state_of(m.get(), d.get()), state);
  EXPECT_FALSE(plugin::Differentiating::nudges(d.get()));
  ASSERT_EQ(t.states, 2 * m->nv);
  const double mass = 2.0, stiffness = 2e5, damping = 40.0, h = m->opt.timestep;
  const double beta = 0.5 * h * damping / mass;
  for (const char plane : {'x', 'y'}) {
    const int x = dof(m.get(), mjcf_names::bending_joint(plane, 1)), v = m->nv + x;
    const double vx = -h * stiffness / mass / (1.0 + beta), vv = (1.0 - beta) / (1.0 + beta);
    // Round-off of a difference: 1e-16 m/s over 2e-8.
    EXPECT_NEAR(at(t, v, x), vx, 1e-6);
    EXPECT_NEAR(at(t, v, v), vv, 1e-6);
    EXPECT_NEAR(at(t, x, x), 1.0 + h * vx, 1e-6);
    EXPECT_NEAR(at(t, x, v), h * vv, 1e-8);
  }
}

// A user's own model has no load that depends on time, so MuJoCo's differences are right there.
TEST_F(Differences, OfAnOwnModelAreMujocos) {
  const ModelPointer m = load(own_model_example());
  const DataPointer d = after(m.get(), 100);
  const plugin::Transition t = plugin::transition(m.get(), d.get(), 1e-6);
  std::vector<double> A(t.A.size()), B(t.B.size()), C(t.C.size()), D(t.D.size());
  mjd_transitionFD(m.get(), d.get(), 1e-6, 1, A.data(), B.data(), C.data(), D.data());
  for (std::size_t i = 0; i < A.size(); ++i)
    EXPECT_NEAR(t.A[i], A[i], 1e-8 * (1.0 + std::abs(A[i])));
  for (std::size_t i = 0; i < B.size(); ++i)
    EXPECT_NEAR(t.B[i], B[i], 1e-8 * (1.0 + std::abs(B[i])));
  for (std::size_t i = 0; i < C.size(); ++i)
    EXPECT_NEAR(t.C[i], C[i], 1e-8 * (1.0 + std::abs(C[i])));
  for (std::size_t i = 0; i < D.size(); ++i)
    EXPECT_NEAR(t.D[i], D[i], 1e-8 * (1.0 + std::abs(D[i])));
}

TEST_F(Differences, WantAPositiveNudge) {
  const ModelPointer m = load(mjcf(shipped("bench_ring")));
  const DataPointer d = start(m.get());
  EXPECT_THROW(plugin::transition(m.get(), d.get(), 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace rotorub::test
