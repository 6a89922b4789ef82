// Lasting rubs with the spin free: against differences of the model's own right-hand side, what
// must not couple, and whole runs of `event`.
#include "native_model/linear/driven_rub.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "native_model/linear/rub_stability.h"
#include "native_model/model/model.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/diagnostic.h"
#include "tests/native_model/hard/rules.h"
#include "tests/native_model/linear/differences.h"
#include "tests/native_model/linear/rubs.h"

namespace rotorub::rub {
namespace {

void add_torsion(scene::Scene& s) {
  scene::Torsion torsion;
  torsion.inertia = {4e-3, 1e-3};
  torsion.stiffness = {600.0, 900.0};
  torsion.damping = {0.1, 0.2};
  torsion.drive_shape = {0.3, -0.5};
  s.rotor.torsion = torsion;
}

// A motor of the slope -gain that keeps the scene's speed under `torque`.
void keep_speed(scene::Scene& s, double gain, double torque) {
  scene::Drive drive;
  drive.kind = scene::DriveKind::kLinear;
  drive.gain = gain;
  drive.speed = s.rotor.speed + torque / gain;
  s.drive = drive;
}

// Three modes, gyroscopics, rotating damping, two torsion modes, a motor; loads: unbalance and a
// force locked to the spin, or none.
scene::Scene driven_scene(bool elastic_ring, bool loaded, double sense = 1.0) {
  scene::Scene s = test::three_modes(elastic_ring);
  s.rotor.speed *= sense;
  add_torsion(s);
  s.rotor.modal->inertia = 0.02;
  s.forces.clear();
  if (loaded) {
    scene::Force locked;
    locked.kind = scene::ForceKind::kSynchronous;
    locked.amplitude = 120.0;
    locked.phase = 0.7;
    locked.shape = {0.8, -0.5, 0.3};
    s.forces.push_back(locked);
    scene::Force unbalance;
    unbalance.kind = scene::ForceKind::kUnbalance;
    unbalance.static_moment = 2e-3;
    unbalance.phase = -0.4;
    unbalance.shape = {1.1, 0.4, -0.2};
    s.forces.push_back(unbalance);
  }
  keep_speed(s, 0.5, 0.0);
  return s;
}

// The start is on the rub; the motor gives the torque of the rub, and torsion has its static twist.
scene::Scene started_driven(scene::Scene s, const RubSystem& system, const SteadyRub& rub) {
  const double torque = torque_taken(system, rub);
  keep_speed(s, s.drive->gain, torque);
  s = test::started_on(s, rub);
  const double friction = system.radius * rub.friction * rub.normal_force;
  const scene::Torsion& t = *s.rotor.torsion;
  s.initial.torsion.clear();
  for (std::size_t k = 0; k < t.stiffness.size(); ++k) {
    s.initial.torsion.push_back((t.drive_shape[k] * torque - friction) / t.stiffness[k]);
  }
  return s;
}

void expect_driven_as_differences(const scene::Scene& scene, const RubSystem& system,
                                  const SteadyRub& rub, std::size_t count) {
  const std::vector<Complex> found = driven_eigenvalues(system, drive_train(scene), rub);
  EXPECT_EQ(found.size(), count);
  const std::vector<Complex> all =
      test::by_differences(prepare(started_driven(scene, system, rub)), rub);
  for (const Complex& s : found) {
    EXPECT_LT(test::nearest_to(s, all), 1e-4 * std::abs(s) + 1e-2)
        << to_string(rub.kind) << ' ' << s;
  }
}

TEST(DrivenRub, GrowsAsTheModelSays) {
  for (const auto& [elastic, sense, friction] :
       {std::tuple{true, 1.0, FrictionLaw(0.2)}, std::tuple{false, 1.0, FrictionLaw(0.2)},
        std::tuple{true, -1.0, FrictionLaw(0.2)}, std::tuple{true, -1.0, test::falling()},
        std::tuple{false, 1.0, test::falling(0.01)}}) {
    SCOPED_TRACE(elastic ? "elastic ring" : "rigid ring");
    SCOPED_TRACE(sense);
    const std::size_t sliding = (elastic ? 14 : 10) + 2 * 3 - 1;  // spin and two torsion modes more
    scene::Scene scene = driven_scene(elastic, true, sense);
    scene.first().contact->friction = friction;
    RubSystem system = rub_system(scene);
    const auto forced = forced_rubs(system, rotating_loads(system).front());
    ASSERT_FALSE(forced.empty());
    for (const SteadyRub& rub : forced) expect_driven_as_differences(scene, system, rub, sliding);
    scene = driven_scene(elastic, false, sense);
    scene.first().contact->friction = friction;
    system = rub_system(scene);
    const auto whips = BackwardCompliance(system).whips(friction);
    ASSERT_FALSE(whips.empty());
    for (const SteadyRub& whip : whips)
      expect_driven_as_differences(scene, system, whip, sliding - 2 + 1);
  }
}

TEST(DrivenRub, RollsAsTheModelSays) {
  for (const bool elastic : {true, false}) {
    SCOPED_TRACE(elastic ? "elastic ring" : "rigid ring");
    scene::Scene scene = driven_scene(elastic, false);
    scene.first().contact->friction = 1e3;
    int met = 0;
    for (const double speed : {6.0, 20.0, 60.0, -60.0}) {
      scene.rotor.speed = speed;
      keep_speed(scene, 0.5, 0.0);
      const RubSystem system = rub_system(scene);
      const auto rolling =
          BackwardCompliance(system).rolling(scene.first().contact->friction.coefficient);
      if (!rolling) continue;
      ++met;
      expect_driven_as_differences(scene, system, *rolling, (elastic ? 12 : 8) + 2 * 3 - 1);
    }
    EXPECT_GT(met, 0);
  }
}

// Without unbalance, loads locked to the spin, gyroscopics and rotating damping, bending and spin
// are independent.
TEST(DrivenRub, SlidingGivesTorsionNoWayBack) {
  scene::Scene scene = driven_scene(true, false);
  scene.rotor.modal->gyroscopic = scene.rotor.modal->internal_damping = {0.0, 0.0, 0.0};
  test::add_rotating_force(scene, 250.0, scene.rotor.speed);
  const RubSystem system = rub_system(scene);
  const DriveTrain train = drive_train(scene);
  const SteadyRub rub = forced_rubs(system, rotating_loads(system).front()).at(0);
  const std::vector<Complex> found = driven_eigenvalues(system, train, rub),
                             held = rub_eigenvalues(system, rub);
  ASSERT_EQ(found.size(), held.size() + 5);
  const double largest =
      std::abs(*std::max_element(held.begin(), held.end(), [](const Complex& a, const Complex& b) {
        return std::abs(a) < std::abs(b);
      }));
  for (const Complex& s : held) EXPECT_LT(test::nearest_to(s, found), 1e-9 * largest) << s;

  // The shaft alone: its motor and its torsion.
  const Eigen::Index k = train.modes();
  Eigen::VectorXd inertia(k + 1), motor(k + 1);
  inertia << train.inertia, train.torsion_inertia;
  motor << 1.0, train.at_motor;
  Eigen::MatrixXd rates = 0.5 * motor * motor.transpose(),
                  springs = Eigen::MatrixXd::Zero(k + 1, k + 1);
  rates.diagonal().tail(k) += train.torsion_damping;
  springs.diagonal().tail(k) = train.torsion_stiffness;
  const Eigen::VectorXd mobility = inertia.cwiseInverse();
  const Eigen::MatrixXd B = mobility.asDiagonal() * rates, C = mobility.asDiagonal() * springs;
  const auto shaft = real_eigenvalues(first_order_form(B, C, frequency_scale(C)));
  for (const Complex& s : shaft.value()) {
    if (std::abs(s) < 1e-6) continue;  // the angle, which may be any
    EXPECT_LT(test::nearest_to(s, found), 1e-9 * largest) << s;
  }
}

// Held at the motor, torsion alone gives way: rolling with two torsion modes.
TEST(DrivenRub, TorsionOfAHeldSpin) {
  scene::Scene scene = driven_scene(true, false);
  scene.drive.reset();
  scene.first().contact->friction = 1e3;
  scene.rotor.speed = 60.0;
  const RubSystem system = rub_system(scene);
  const SteadyRub rub = BackwardCompliance(system).rolling(1e3).value();
  const DriveTrain train = drive_train(scene);
  const std::vector<Complex> found = driven_eigenvalues(system, train, rub);
  EXPECT_EQ(found.size(), 12U + 4U);
  scene::Scene started = test::started_on(scene, rub);
  for (Eigen::Index k = 0; k < 2; ++k) {
    started.initial.torsion.push_back(-train.at_contact[k] * system.radius * rub.friction *
                                      rub.normal_force / train.torsion_stiffness[k]);
  }
  const std::vector<Complex> all = test::by_differences(prepare(started), rub);
  for (const Complex& s : found)
    EXPECT_LT(test::nearest_to(s, all), 1e-4 * std::abs(s) + 1e-2) << s;
}

TEST(DrivenRub, RefusesAMotorThatFollowsATimeTable) {
  scene::Scene scene = driven_scene(true, false);
  scene.drive->kind = scene::DriveKind::kSpeedControlled;
  scene.drive->acceleration = 10.0;
  EXPECT_THROW(drive_train(scene), scene::SceneError);
}

}  // namespace
}  // namespace rotorub::rub
