// The actuator between the controller's wish and the ring.
#include "native_model/model/actuation.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/scene.h"

#include <gtest/gtest.h>

#include <limits>

#include "native_model/bearing/actuator.h"
#include "native_model/model/dynamics.h"
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

TEST(Actuation, MagnetsGiveTheForceAskedFor) {
  const Model m = prepare(magnetic_scene());
  for (unsigned seed = 0; seed < 50; ++seed) {
    const State s = test::random_state(m, seed);
    const double *q = s.q.data(), *v = s.v.data();
    const Eigen::Vector2d wanted = -8e4 * stator_point(m, q) - 150.0 * stator_point(m, v);
    const ActuatorState a = actuator_state(m, q, v, control_command(m, s.t, q, v));
    EXPECT_LT((a.force - wanted).norm(), 1e-12 * wanted.norm()) << seed;
    EXPECT_LE(a.current.cwiseAbs().maxCoeff(), 2.0);
  }
}

TEST(Actuation, TheLoadsHoldTheForceOnTheRingAlone) {
  const Model m = prepare(magnetic_scene());
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

TEST(Coils, AreNoMechanicalEnergy) {
  const Model with = prepare(magnetic_scene(2e-4)), without = without_coils(with);
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
