// Work and energy: what the loads do, summed along a fine Runge-Kutta solution, is the change of
// kinetic and elastic energy.
#include <gtest/gtest.h>

#include <cmath>

#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/scene.h"
#include "tests/support/machine.h"
#include "tests/support/runge_kutta.h"

namespace rotorub {
namespace {

const Eigen::Vector2d kActuator{7.0, -3.0};  // N, on the ring

// y = (q, v, work of external_power) from a random state over 20 ms: more than one turn of the
// shaft, several periods of every mode.
struct Balance {
  double change, work, scale;
};

Balance balance(const Model& m, int steps) {
  const int n = m.nq();
  const State start = test::random_state(m, 21);
  const auto rate = [&](double t, const Eigen::VectorXd& y) {
    Eigen::VectorXd dy(2 * n + 1);
    const double *q = y.data(), *v = q + n;
    dy.head(n) = y.segment(n, n);
    smooth_force(m, t, q, v, kActuator, dy.data() + n);
    solve_mass(m, t, q, dy.data() + n, dy.data() + n);
    dy[2 * n] = external_power(m, t, q, v, kActuator);
    return dy;
  };
  Eigen::VectorXd y(2 * n + 1);
  y << start.q, start.v, 0.0;
  const double end = start.t + 0.02, before = energy(m, start.t, start.q.data(), start.v.data());
  y = test::runge_kutta(rate, start.t, end, steps, y);
  const double after = energy(m, end, y.data(), y.data() + n);
  return {after - before, y[2 * n], std::max(std::abs(before), std::abs(after))};
}

// Relative to the largest energy; RK4 at 5 us of modes up to 2000 rad/s is accurate to (w h)^4.
constexpr double kBalance = 1e-8;

void expect_balance(const Model& m) {
  const Balance coarse = balance(m, 1000), fine = balance(m, 4000);
  const double error = std::abs(fine.change - fine.work) / fine.scale;
  EXPECT_LT(error, kBalance);
  // The remaining error comes from the step: a wrong term would not shrink.
  EXPECT_LT(error, 0.05 * std::abs(coarse.change - coarse.work) / coarse.scale + 1e-13);
  EXPECT_GT(std::abs(fine.work), 1e-3 * fine.scale) << "the loads do work, or nothing is tested";
}

TEST(EnergyBalance, EverythingAtOnceWithAFreeSpin) { expect_balance(test::machine(true)); }

TEST(EnergyBalance, EverythingAtOnceWithAHeldSpeed) { expect_balance(test::machine(false)); }

TEST(EnergyBalance, GeometryFormWithDriveAndUnbalance) {
  scene::Scene s = test::machine_scene(true);
  scene::RotorGeometry g;
  g.length = 0.6;
  g.E = 2.1e11;
  g.G = 8e10;
  g.rho = 7850.0;
  g.modes = 2;
  g.damping_ratio = 0.01;
  g.internal_damping_ratio = 0.003;
  g.sections = {{.from = 0.0, .to = 0.6, .diameter = 0.018}};
  g.discs = {{.z = 0.25, .mass = 2.0, .Jt = 2e-3, .Jp = 4e-3, .eccentricity = 2e-3, .phase = 1.0}};
  g.bearings = {{.z = 0.03, .stiffness = {2e7, 1e7}, .damping = {50.0, 20.0}},
                {.z = 0.57, .stiffness = {1e7, 2e7}}};
  s.rotor.modal.reset();
  s.rotor.geometry = g;
  s.rotor.torsion.emplace();
  s.rotor.torsion->modes = 1;
  s.rotor.torsion->damping_ratio = 0.01;
  s.drive->inertia = 2e-3;
  s.drive->station = 0.05;
  s.first().contact->station = 0.4;
  for (scene::Force& f : s.forces) f.station = 0.5;
  const Model m = prepare(s);
  ASSERT_TRUE(m.coupled_mass());
  // The first torsion mode is near 10,000 rad/s.
  const Balance fine = balance(m, 16000);
  EXPECT_LT(std::abs(fine.change - fine.work), kBalance * fine.scale);
  EXPECT_GT(std::abs(fine.work), 1e-3 * fine.scale);
}

TEST(Energy, IsKineticAndElastic) {
  const Model m = test::machine(true);
  const State s = test::random_state(m, 22);
  double elastic = 0.5 * s.q.dot(m.stiffness.cwiseProduct(s.q));
  // The magnetic bearing: -k/2 r^2 in each plane.
  const Eigen::Vector2d shape{0.8, -1.3};
  elastic -=
      0.5 * 3e4 *
      (std::pow(shape.dot(s.q.segment<2>(0)), 2) + std::pow(shape.dot(s.q.segment<2>(2)), 2));
  const double exact = test::kinetic_energy(m, s.q, s.v) + elastic;
  EXPECT_NEAR(energy(m, s.t, s.q.data(), s.v.data()), exact, 1e-13 * std::abs(exact));
}

}  // namespace
}  // namespace rotorub
