// The actuator between the controller's wish and the ring.
#include "native_model/system/actuation.h"
#include "native_model/scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "native_model/bearing/actuator.h"
#include "native_model/dynamics/dynamics.h"
#include "tests/support/machine.h"

namespace rotorub {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

scene::Scene magnetic_scene(double coil_lag = 0.0, double rate = kNever) {
  scene::Scene s = test::machine_scene(true);
  s.first().actuator = scene::Actuator{.kind = scene::ActuatorKind::kElectromagnet,
                                       .force_constant = 4e-4,
                                       .bias_current = 3.0,
                                       .air_gap = 5e-3,
                                       .current_limit = 2.0,
                                       .coil_lag = coil_lag,
                                       .current_rate_limit = rate};
  s.first().controller = scene::Controller{};
  s.first().controller->stiffness = 8e4;
  s.first().controller->damping = 150.0;
  return s;
}

TEST(Axes, AreOrthonormalAndTurnedBy45Degrees) {
  EXPECT_NEAR(to_axes({1.0, 1.0}).x(), std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(to_axes({-1.0, 1.0}).y(), std::sqrt(2.0), 1e-15);
  const Eigen::Vector2d r{0.3, -0.7};
  EXPECT_LT((from_axes(to_axes(r)) - r).norm(), 1e-15);
}

TEST(Actuation, MagnetsGiveTheForceAskedFor) {
  const Model m = make_model(magnetic_scene());
  for (unsigned seed = 0; seed < 50; ++seed) {
    const State s = test::random_state(m, seed);
    const double *q = s.q.data(), *v = s.v.data();
    const Eigen::Vector2d wanted = -8e4 * stator_point(m, q) - 150.0 * stator_point(m, v);
    const ActuatorState a = actuator_state(m, q, v, control_command(m, s.t, q, v));
    EXPECT_LT((a.force - wanted).norm(), 1e-12 * wanted.norm()) << seed;
    EXPECT_LE(a.current.cwiseAbs().maxCoeff(), 2.0);
  }
}

TEST(Actuation, MagnetsKeepToTheirCurrent) {
  Model m = make_model(magnetic_scene());
  m.first().magnets->current_limit = 1e-3;
  const State s = test::random_state(m, 3);
  const double *q = s.q.data(), *v = s.v.data();
  const Eigen::Vector2d i = control_command(m, s.t, q, v);
  EXPECT_EQ(i.cwiseAbs(), Eigen::Vector2d(1e-3, 1e-3));
  EXPECT_EQ(actuator_state(m, q, v, i).current, i);
}

// Before the controller is on, the bias current pulls the ring off the middle all the same.
TEST(Actuation, MagnetsActWithoutACommand) {
  scene::Scene scene = magnetic_scene();
  scene.first().controller.reset();
  const Model m = make_model(scene);
  const State s = test::random_state(m, 4);
  const Eigen::Vector2d axes = to_axes(stator_point(m, s.q.data()));
  const ActuatorState a = actuator_state(m, s.q.data(), s.v.data(), {0.0, 0.0});
  const Eigen::Vector2d force = to_axes(a.force);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(force[k], m.first().magnets->law->force(axes[k], 0.0), 1e-12 * std::abs(force[k]));
    EXPECT_GT(force[k] * axes[k], 0.0);
  }
}

TEST(Actuation, TheLoadsHoldTheForceOnTheRingAlone) {
  const Model m = make_model(magnetic_scene());
  const State s = test::random_state(m, 5);
  const double *q = s.q.data(), *v = s.v.data();
  Eigen::VectorXd with(m.nq()), without(m.nq());
  smooth_force(m, s.t, q, v, {1.0, -0.5}, with.data());
  unactuated_force(m, s.t, q, v, without.data());
  const Eigen::Vector2d force = actuator_state(m, q, v, {1.0, -0.5}).force;
  Eigen::VectorXd difference = with - without;
  EXPECT_LT((difference.segment<2>(m.layout.ring()) - force).norm(), 1e-12 * force.norm());
  difference.segment<2>(m.layout.ring()).setZero();
  EXPECT_EQ(difference.norm(), 0.0);
}

TEST(Coils, TheirCurrentFollowsTheCommand) {
  const Model m = make_model(magnetic_scene(2e-4));
  ASSERT_EQ(m.layout.coils, 2);
  ASSERT_EQ(m.nq(), m.layout.mechanical() + 2);
  State s = test::random_state(m, 6);
  s.v.segment<2>(m.layout.coil()) << 0.4, -1.1;
  const double *q = s.q.data(), *v = s.v.data();
  Eigen::VectorXd a(m.nq());
  smooth_force(m, s.t, q, v, {1.5, 0.2}, a.data());
  solve_mass(m, s.t, q, a.data(), a.data());
  EXPECT_NEAR(a[m.layout.coil()], (1.5 - 0.4) / 2e-4, 1e-9);
  EXPECT_NEAR(a[m.layout.coil() + 1], (0.2 + 1.1) / 2e-4, 1e-9);
  EXPECT_EQ(actuator_state(m, q, v, {1.5, 0.2}).current, Eigen::Vector2d(0.4, -1.1));
}

TEST(Coils, TheRateOfTheirCurrentIsLimited) {
  const Model m = make_model(magnetic_scene(2e-4, 1000.0));
  State s = test::random_state(m, 7);
  s.v.segment<2>(m.layout.coil()) << 0.4, -1.1;
  Eigen::VectorXd a(m.nq());
  smooth_force(m, s.t, s.q.data(), s.v.data(), {1.5, -1.2}, a.data());
  solve_mass(m, s.t, s.q.data(), a.data(), a.data());
  EXPECT_NEAR(a[m.layout.coil()], 1000.0, 1e-9) << "5500 A/s asked for";
  EXPECT_NEAR(a[m.layout.coil() + 1], -0.1 / 2e-4, 1e-9) << "within the limit";
}

// L di/dt = u - R i with |u| <= U: 55 V and -45 V are asked for.
TEST(Coils, TheirVoltageIsLimited) {
  scene::Scene scene = magnetic_scene(2e-4);
  scene.first().actuator->voltage_limit = 12.0;
  scene.first().actuator->inductance = 0.01;
  scene.first().actuator->resistance = 2.0;
  const Model m = make_model(scene);
  State s = test::random_state(m, 8);
  s.v.segment<2>(m.layout.coil()) << 0.4, -1.1;
  const auto rates = [&](double first, double second) -> Eigen::Vector2d {
    Eigen::VectorXd a(m.nq());
    smooth_force(m, s.t, s.q.data(), s.v.data(), {first, second}, a.data());
    solve_mass(m, s.t, s.q.data(), a.data(), a.data());
    return a.segment<2>(m.layout.coil());
  };
  EXPECT_LT((rates(1.5, -2.0) - Eigen::Vector2d((12.0 - 0.8) / 0.01, (-12.0 + 2.2) / 0.01)).norm(),
            1e-9);
  EXPECT_LT((rates(-2.0, 2.0) - Eigen::Vector2d((-12.0 - 0.8) / 0.01, (12.0 + 2.2) / 0.01)).norm(),
            1e-9);
  EXPECT_LT((rates(0.5, -1.2) - Eigen::Vector2d(500.0, -500.0)).norm(), 1e-9) << "within the limit";
}

TEST(Coils, AreNoMechanicalEnergy) {
  const Model with = make_model(magnetic_scene(2e-4)), without = without_coils(with);
  EXPECT_EQ(without.nq(), with.layout.mechanical());
  EXPECT_EQ(without.layout.coils, 0);
  State s = test::random_state(with, 8);
  s.v.tail<2>() << 2.0, 1.0;
  EXPECT_EQ(energy(with, s.t, s.q.data(), s.v.data()),
            energy(without, s.t, s.q.data(), s.v.data()));
  EXPECT_EQ(external_power(with, s.t, s.q.data(), s.v.data(), {3.0, 4.0}),
            external_power(without, s.t, s.q.data(), s.v.data(), {3.0, 4.0}));
}

}  // namespace
}  // namespace rotorub
