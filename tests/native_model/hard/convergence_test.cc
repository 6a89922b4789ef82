// `euler` tends to `event` at first order: a tenth of the step, a tenth of the error.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/native_model/hard/rules.h"

namespace rotorub {
namespace {

double distance(const Trajectory& a, const Trajectory& b) {
  double most = 0.0;
  for (const char* column : {"rotor_x", "rotor_y", "stator_x", "stator_y"}) {
    for (std::size_t k = 0; k < a.rows(); ++k) {
      most = std::max(most, std::abs(a.column(column)[k] - b.column(column)[k]));
    }
  }
  return most;
}

// Over two decades of steps. Impacts fall at random within their steps, so that single ratios
// scatter around 10; over both decades a first-order scheme gains a factor of 100.
void expect_first_order(const scene::Scene& scene) {
  SCOPED_TRACE(scene.name);
  const Trajectory exact = test::sound_event(scene);
  EXPECT_GT(exact.statistics.first_touch, 0.0);
  const auto at = [&](double step) {
    return distance(test::run_with(scene, scene::Integrator::kEuler, step), exact);
  };
  const double coarse = at(2e-5);
  const double middle = at(2e-6);
  const double fine = at(2e-7);
  EXPECT_LT(middle, coarse / 3.0);
  EXPECT_LT(fine, middle / 3.0);
  EXPECT_LT(fine, coarse / 30.0) << coarse << ' ' << middle << ' ' << fine;
  EXPECT_GT(fine, coarse / 3000.0) << "a faithful first-order scheme: " << coarse << ' ' << fine;
}

TEST(HardConvergence, TwoModesWithTorsionAndGyroscopics) {
  scene::Scene scene = test::shipped("bench_ring");
  scene.name = "two_modes";
  scene::RotorModal& m = *scene.rotor.modal;
  m.mass = m.mass_y = {2.0, 0.8};
  m.stiffness = m.stiffness_y = {2e5, 3e6};
  m.damping = m.damping_y = {60.0, 200.0};
  m.internal_damping = {5.0, 5.0};
  m.gyroscopic = {0.05, 0.1};
  scene.rotor.torsion = scene::Torsion{0, 0.0, {4e-4}, {60.0}, {0.02}, {-0.5}};
  scene.first().contact->restitution = 0.2;
  scene.forces[0].shape = {1.0, 0.3};
  scene.forces[0].ramp = 0.01;
  scene.run.end = 0.03;
  expect_first_order(scene);
}

}  // namespace
}  // namespace rotorub
