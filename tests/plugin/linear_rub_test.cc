// The step's linearisation in lasting contact against the native linear theory of the rub: seen
// from the frame that turns with it, the eigenvalues of A are those of linear/rub_stability.h.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "native_model/linear/rub_stability.h"
#include "native_model/numerics/eigenvalues.h"
#include "plugin/differences.h"
#include "plugin/linearise.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

using LinearRub = HookedTest;
using Complex = std::complex<double>;

bool by_imaginary(const Complex& a, const Complex& b) {
  return a.imag() != b.imag() ? a.imag() < b.imag() : a.real() < b.real();
}

// Pairs (x, y) of degrees of freedom: rotor and ring; each turns with the frame, and so do their
// rates.
Eigen::MatrixXd frame_turn(const mjModel* m, double angle) {
  const auto dof = [m](const std::string& joint) {
    return m->jnt_dofadr[mj_name2id(m, mjOBJ_JOINT, joint.c_str())];
  };
  const std::pair<int, int> pairs[] = {
      {dof(mjcf_names::bending_joint('x', 1)), dof(mjcf_names::bending_joint('y', 1))},
      {dof(mjcf_names::kRingX), dof(mjcf_names::kRingY)}};
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::MatrixXd turn = Eigen::MatrixXd::Identity(2 * m->nv, 2 * m->nv);
  for (const auto& [x, y] : pairs) {
    for (const int shift : {0, static_cast<int>(m->nv)}) {
      turn(x + shift, x + shift) = turn(y + shift, y + shift) = c;
      turn(x + shift, y + shift) = -s;
      turn(y + shift, x + shift) = s;
    }
  }
  return turn;
}

TEST_F(LinearRub, HasTheEigenvaluesOfTheNativeTheory) {
  const scene::Scene scene = shipped("bench_annular_elastic");
  const ModelPointer m = load(mjcf(scene));
  const double h = m->opt.timestep;
  const DataPointer d = start(m.get());
  for (int k = 0; k < 200; ++k) mj_step(m.get(), d.get());
  ASSERT_GT(sensor(m.get(), d.get(), mjcf_names::kNormalForce), 100.0);
  const plugin::Transition t = plugin::transition(m.get(), d.get(), 1e-9);
  const Eigen::MatrixXd A =
      Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          t.A.data(), t.states, t.states);

  const rub::RubSystem system = rub::rub_system(scene);
  const auto rubs = rub::forced_rubs(system, rub::rotating_loads(system).front());
  ASSERT_FALSE(rubs.empty());
  std::vector<Complex> expected = rub::rub_eigenvalues(system, rubs.front());
  ASSERT_EQ(expected.size(), 6U);

  const auto values = real_eigenvalues(frame_turn(m.get(), -rubs.front().whirl * h) * A);
  ASSERT_TRUE(values);
  std::vector<Complex> found, held;
  for (const Complex& value : *values) {
    if (std::abs(value) > 0.5) {
      found.push_back(std::log(value) / h);
    } else {
      held.push_back(value);  // the gap and its rate: the step ends on the circle
    }
  }
  ASSERT_EQ(held.size(), 2U);
  ASSERT_EQ(found.size(), expected.size());
  std::sort(found.begin(), found.end(), by_imaginary);
  std::sort(expected.begin(), expected.end(), by_imaginary);
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_LT(std::abs(found[k] - expected[k]), 1e-3 * std::abs(expected[k]) + 0.1)
        << k << ": " << found[k] << " for " << expected[k];
  }
}

// In flight: the free rotor and ring, M a = -K x - D v, to the error of a step of first order.
TEST_F(LinearRub, InFlightIsTheFreeMachine) {
  const ModelPointer m = load(own_model_example());
  const DataPointer d = start(m.get());
  const plugin::LinearSystem system = plugin::linearise(m.get(), d.get(), 1e-6);
  EXPECT_TRUE(system.held.isZero(0.0));
  const int nv = m->nv, ring = 3;  // bend_x, bend_y, spin, ring_x, ring_y
  const double h = m->opt.timestep;
  EXPECT_NEAR(system.A(ring, nv + ring), 1.0, h * 200.0);
  EXPECT_NEAR(system.A(nv + ring, ring), -1e5, h * 200.0 * 1e5);
  EXPECT_NEAR(system.A(nv + ring, nv + ring), -200.0, h * (1e5 + 200.0 * 200.0));
  // ctrl 1 pushes the ring along x with 1 N on 1 kg, ctrl 2 along y.
  EXPECT_NEAR(system.B(nv + ring, 1), 1.0, h * 200.0);
  EXPECT_NEAR(system.B(nv + ring, 2), 0.0, 1e-6);
}

// A state that was just set and one a step later have one linear system in flight, although the
// first step of `rigid` is half a kick.
TEST_F(LinearRub, OfAStateThatWasJustSet) {
  scene::Scene scene = shipped("bench_ring");
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  const plugin::LinearSystem fresh = plugin::linearise(m.get(), d.get(), 1e-7);
  mj_forward(m.get(), d.get());
  const plugin::LinearSystem passed = plugin::linearise(m.get(), d.get(), 1e-7);
  for (int k = 0; k < 3; ++k) mj_step(m.get(), d.get());
  const plugin::LinearSystem later = plugin::linearise(m.get(), d.get(), 1e-7);
  const double size = later.A.norm();
  EXPECT_LT((fresh.A - later.A).norm(), 1e-6 * size);
  EXPECT_LT((passed.A - later.A).norm(), 1e-6 * size);
}

// In lasting contact no state changes the gap, and held motions do not continue.
TEST_F(LinearRub, HoldsTheGap) {
  const ModelPointer m = load(mjcf(shipped("bench_annular_elastic")));
  const DataPointer d = start(m.get());
  for (int k = 0; k < 200; ++k) mj_step(m.get(), d.get());
  const plugin::LinearSystem system = plugin::linearise(m.get(), d.get(), 1e-9);
  EXPECT_NEAR(system.held.trace(), 2.0, 1e-6);
  EXPECT_LT((system.held * system.held - system.held).norm(), 1e-6 * system.held.norm());
  EXPECT_LT((system.A * system.held).norm(), 1e-6 * system.A.norm());
  const plugin::Transition t = plugin::transition(m.get(), d.get(), 1e-9);
  const Eigen::MatrixXd step =
      Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          t.A.data(), t.states, t.states);
  // exp(A h) on what is free.
  Eigen::MatrixXd power = Eigen::MatrixXd::Identity(t.states, t.states), sum = power;
  for (int j = 1; j < 20; ++j) {
    power = power * system.A * m->opt.timestep / j;
    sum += power;
  }
  const Eigen::MatrixXd free = Eigen::MatrixXd::Identity(t.states, t.states) - system.held;
  EXPECT_LT((sum * free - step * free).norm(), 1e-9 * step.norm());
}

}  // namespace
}  // namespace rotorub::test
