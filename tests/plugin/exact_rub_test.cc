// Rubs with a known answer in MuJoCo, and their linearisation.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "native_model/linear/rub_stability.h"
#include "native_model/model/dynamics.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/oracles/annular_rub.h"
#include "plugin/differences.h"
#include "plugin/linearise.h"
#include "tests/plugin/scenes.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;
using Complex = std::complex<double>;
using LinearRub = HookedTest;

// The force of an annular rub is to be met at a step of 1e-5; MuJoCo's implicit damping alone, d
// times the velocity of half a step away, makes 6.5e-5 of it.
constexpr double kForce = 1e-4;
constexpr double kScatter = 1e-3;

struct NormalForce {
  double mean = 0.0, deviation = 0.0;  // N
  int steps_in_contact = 0;
};

// Over the last `steps` of a scene; the friction force is the law's at each of them.
NormalForce normal_force(const scene::Scene& scene, int steps) {
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  const auto all = static_cast<int>(std::lround(scene.run.end / scene.run.step));
  double sum = 0.0, squares = 0.0;
  NormalForce out;
  for (int k = 0; k < all; ++k) {
    mj_step(m.get(), d.get());
    if (k < all - steps) continue;
    const double force = sensor(m.get(), d.get(), names::kNormalForce);
    sum += force;
    squares += force * force;
    if (force > 0.0) ++out.steps_in_contact;
    EXPECT_NEAR(sensor(m.get(), d.get(), names::kFrictionForce),
                -scene.first().contact->friction.coefficient * force, 1e-9 * force);
  }
  out.mean = sum / steps;
  out.deviation = std::sqrt(std::max(0.0, squares / steps - out.mean * out.mean));
  return out;
}

class ExactRub : public HookedTest, public testing::WithParamInterface<const char*> {
 protected:
  static scene::Scene rub(const std::string& text, std::vector<std::string> overrides = {}) {
    overrides.push_back(std::string("mujoco.contact=") + GetParam());
    return parsed(text, overrides);
  }
  static bool is_rigid() { return GetParam() == std::string("rigid"); }
  static void expect_steady(const scene::Scene& scene, double exact) {
    const NormalForce found = normal_force(scene, 20000);
    EXPECT_NEAR(found.mean, exact, kForce * exact);
    EXPECT_LT(found.deviation, kScatter * exact);
    EXPECT_EQ(found.steps_in_contact, 20000);
  }
};

// Of kAnnularRub, and of it on kElasticRing.
constexpr double kWhirlSpeed = 100.0 * std::numbers::pi;  // rad/s
constexpr oracle::Support kRubRotor{2.0, 40.0, 3e5}, kRubRing{1.0, 200.0, 4e5};

double rigid_ring_force() {
  return oracle::annular_rub(kRubRotor, 0.5e-3, 0.2, 200.0, kWhirlSpeed).value().force;
}

TEST_P(ExactRub, OnARigidRing) {
  for (const char* integrator : {"euler", "implicit"}) {
    SCOPED_TRACE(integrator);
    expect_steady(rub(kAnnularRub, {std::string("mujoco.integrator=") + integrator}),
                  rigid_ring_force());
  }
}

TEST_P(ExactRub, OnAnElasticRing) {
  const auto exact = oracle::annular_rub(kRubRotor, kRubRing, 0.5e-3, 0.2, 200.0, kWhirlSpeed);
  ASSERT_TRUE(exact);
  expect_steady(rub(kAnnularRub + kElasticRing), exact->force);
}

TEST_P(ExactRub, TheErrorFallsWithTheStep) {
  const double exact = rigid_ring_force();
  const double coarse =
      std::abs(normal_force(rub(kAnnularRub, {"run.step=1e-4"}), 2000).mean - exact);
  const double fine =
      std::abs(normal_force(rub(kAnnularRub, {"run.step=1e-5"}), 2000).mean - exact);
  EXPECT_LT(fine, 0.15 * coarse);
  EXPECT_LT(coarse, 1e-3 * exact);
}

// The spin comes to rest and stays: friction must not turn it to and fro.
TEST_P(ExactRub, SticksWithoutFlippingItsSign) {
  const ModelPointer m = load(mjcf(rub(kBrake)));
  const DataPointer d = start(m.get());
  int flips = 0, last = 0;
  for (int k = 0; k < 10000; ++k) {
    mj_step(m.get(), d.get());
    const double slip = sensor(m.get(), d.get(), names::kSlip);
    const int sign = std::abs(slip) > 1e-9 ? (slip > 0.0 ? 1 : -1) : 0;
    if (sign != 0 && last != 0 && sign != last) ++flips;
    if (sign != 0) last = sign;
    const double normal = sensor(m.get(), d.get(), names::kNormalForce);
    EXPECT_LE(std::abs(sensor(m.get(), d.get(), names::kFrictionForce)), 0.5 * normal + 1e-9);
  }
  EXPECT_LE(flips, 2);
  EXPECT_NEAR(sensor(m.get(), d.get(), names::kSlip), 0.0, 1e-9);
  EXPECT_NEAR(sensor(m.get(), d.get(), names::kNormalForce), 100.0, is_rigid() ? 1.0 : 50.0);
}

INSTANTIATE_TEST_SUITE_P(, ExactRub, testing::Values("rigid", "coulomb"),
                         [](const auto& of) { return std::string(of.param); });

// ---------------------------------------------------------------- rigid
// Contact model `rigid` against the exact answers of bounces, and its behaviour inside MuJoCo.

using RigidContact = HookedTest;

scene::Scene rigid(const std::string& text, std::vector<std::string> overrides = {}) {
  overrides.push_back("mujoco.contact=rigid");
  return parsed(text, overrides);
}

scene::Scene rigid_bench(const std::string& name, std::vector<std::string> overrides = {}) {
  overrides.push_back("mujoco.contact=rigid");
  return shipped(name, overrides);
}

// Without loads a bounce on the ring keeps energy and angular momentum: 101 impacts in 0.2 s.
TEST_F(RigidContact, ABilliardKeepsEnergyAndAngularMomentum) {
  const scene::Scene scene = rigid_bench("bench_billiard", {"run.step=1e-5"});
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  const auto momentum = [&] { return d->qpos[0] * d->qvel[1] - d->qpos[1] * d->qvel[0]; };
  const auto energy = [&] { return mju_dot(d->qvel, d->qvel, 2); };
  const double energy_start = energy(), momentum_start = momentum();
  int impacts = 0;
  for (int k = 0; k < 20000; ++k) {
    mj_step(m.get(), d.get());
    if (sensor(m.get(), d.get(), names::kNormalForce) > 0.0) ++impacts;
  }
  EXPECT_GE(impacts, 100);
  EXPECT_LE(impacts, 102);
  constexpr double kKept = 1e-9;  // relative; the chain's links weigh 5e-13 of the rotor
  EXPECT_NEAR(energy(), energy_start, kKept * energy_start);
  EXPECT_NEAR(momentum(), momentum_start, kKept * std::abs(momentum_start));
}

TEST_F(RigidContact, IsSeenByMujocoButNotSolvedByIt) {
  const ModelPointer m = load(mjcf(rigid(kAnnularRub)));
  const DataPointer d = start(m.get());
  for (int k = 0; k < 20000; ++k) mj_step(m.get(), d.get());
  mj_forward(m.get(), d.get());
  ASSERT_EQ(d->ncon, 1);
  EXPECT_EQ(d->contact[0].exclude, 1);  // in gap
  EXPECT_EQ(d->contact[0].efc_address, -1);
  EXPECT_EQ(d->nefc, 0);
  EXPECT_NEAR(d->contact[0].dist, 0.0, 1e-9);
  EXPECT_NEAR(std::hypot(d->contact[0].pos[0], d->contact[0].pos[1]), 0.05 + 0.5e-3, 1e-9);
}

// A contact lasts only from one step to the next. A state that is written at any other time begins
// without one.
TEST_F(RigidContact, AStateAtAnotherTimeIsSteppedAsAFreshOne) {
  const ModelPointer m = load(mjcf(rigid(kAnnularRub)));
  const DataPointer used = start(m.get()), fresh = start(m.get());
  for (int k = 0; k < 20000; ++k) mj_step(m.get(), used.get());
  ASSERT_GT(sensor(m.get(), used.get(), names::kNormalForce), 0.0);
  used->time += 7.5 * m->opt.timestep;
  for (int i = 0; i < 2; ++i) used->qvel[i] += 200.0 * used->qpos[i];  // about 0.1 m/s outward
  fresh->time = used->time;
  mju_copy(fresh->qpos, used->qpos, m->nq);
  mju_copy(fresh->qvel, used->qvel, m->nv);
  mj_step(m.get(), used.get());
  mj_step(m.get(), fresh.get());
  for (int i = 0; i < m->nv; ++i) EXPECT_EQ(used->qvel[i], fresh->qvel[i]) << i;
}

// A user's load acts, and the plugin does not change it.
TEST_F(RigidContact, LeavesTheUsersForcesAlone) {
  const ModelPointer m = load(mjcf(rigid(kBrake)));
  const DataPointer d = start(m.get());
  const int y = m->jnt_dofadr[mj_name2id(m.get(), mjOBJ_JOINT, "y_1")];
  d->qfrc_applied[y] = -50.0;
  d->xfrc_applied[6 * mj_name2id(m.get(), mjOBJ_BODY, names::kRotor) + 1] = -25.0;
  for (int k = 0; k < 10000; ++k) mj_step(m.get(), d.get());
  EXPECT_EQ(d->qfrc_applied[y], -50.0);
  EXPECT_NEAR(sensor(m.get(), d.get(), names::kNormalForce), 175.0, 1.75);
}

// ---------------------------------------------------------------- linearised
// The step's linearisation in lasting contact against the native linear theory of the rub: seen
// from the frame that turns with it, the eigenvalues of A are those of linear/rub_stability.h.

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
