// The linear part of bending: against the loads themselves, and against the matrices of the whirl
// analysis, which are put together from the rotor without a model.
#include "native_model/model/linear_parts.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>

#include <limits>

#include "native_model/bearing/actuator.h"
#include "native_model/linear/whirl_system.h"
#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"
#include "native_model/scene/scene.h"
#include "tests/support/machine.h"

namespace rotorub {
namespace {

constexpr double kOfSums = 1e-13;  // of the largest entry, after sums of a few terms

// The machine with every linear load that a model knows, the spin held.
Model machine_with_all() {
  Model m = test::machine(false);
  const ModeShape shape{Eigen::Vector2d(0.7, -0.4), Eigen::Vector2d(0.5, 0.9)};
  m.dampers.push_back({shape, {13.0, 29.0}});
  StationFilm film{shape, {}};
  film.law.constant = {2e4, 7e3, -9e3, 1e4, 31.0, 3.0, -5.0, 17.0};
  m.films.push_back(film);
  StationFeedback feedback{shape, {}, {}};
  feedback.law.negative_stiffness = 3e4;
  feedback.law.force_per_current = 110.0;
  feedback.law.proportional = 900.0;
  feedback.law.derivative = 2.0;
  feedback.law.current_limit = 1e300;
  m.feedbacks = {feedback};
  return m;
}

TEST(LinearParts, AreTheChangeOfTheLoadsWithTheState) {
  const Model m = machine_with_all();
  const int bending = 2 * m.layout.modes;
  const LinearParts parts = linear_parts(m, m.speed);
  State at = test::random_state(m, 5);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(m.nq());
  Eigen::VectorXd loaded(m.nq()), unloaded(m.nq());
  unactuated_force(m, at.t, at.q.data(), at.v.data(), loaded.data());
  unactuated_force(m, at.t, rest.data(), rest.data(), unloaded.data());
  const Eigen::VectorXd change = (loaded - unloaded).head(bending);
  const Eigen::VectorXd linear =
      parts.stiffness * at.q.head(bending) + parts.damping * at.v.head(bending);
  EXPECT_GT(linear.norm(), 0.0);
  EXPECT_LT((change + linear).norm(), kOfSums * (linear.norm() + unloaded.norm()));
}

TEST(LinearParts, AreThoseOfTheWhirlAnalysis) {
  const scene::Scene scene = test::machine_scene(false);
  const Model m = prepare(scene);
  for (const double speed : {0.0, 310.0, -95.0}) {
    const LinearParts parts = linear_parts(m, speed);
    const PlanesMatrices whirl = planes_matrices(whirl_system(scene), speed);
    const Eigen::VectorXd inverse = parts.mass.cwiseSqrt().cwiseInverse();
    const auto of_unit_mass = [&](const Eigen::MatrixXd& matrix) -> Eigen::MatrixXd {
      return inverse.asDiagonal() * matrix * inverse.asDiagonal();
    };
    EXPECT_LT((of_unit_mass(parts.damping) - whirl.damping).norm(), kOfSums * whirl.damping.norm())
        << speed;
    EXPECT_LT((of_unit_mass(parts.stiffness) - whirl.stiffness).norm(),
              kOfSums * whirl.stiffness.norm())
        << speed;
  }
}

// ---------------------------------------------------------------- actuation
// The actuator between the controller's wish and the ring.

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

TEST(Actuation, TheLoadsContainOnlyTheForceOnTheRing) {
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
