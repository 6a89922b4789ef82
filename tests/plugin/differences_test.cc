// The step linearised: against the closed form of the modal step in flight, and MuJoCo's own
// differences where those hold. (In lasting contact: linear_rub_test.cc.)
#include "plugin/differences.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

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
  EXPECT_FALSE(plugin::differentiating());
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

// A model of the user's own has no load of its own time: there MuJoCo's differences hold.
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
