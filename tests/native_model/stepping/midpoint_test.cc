// The paper's time stepping against exact answers. Its error is of first order, so tolerances are
// given at a step and the rate is tested beside them.
#include "native_model/stepping/stepper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "native_model/oracles/annular_rub.h"
#include "native_model/oracles/bounces.h"
#include "native_model/run/run_native.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/oracles/elastic_whip.h"

namespace rotorub {
namespace {

using test::Jeffcott;
using test::make_scene;
using test::shipped;

Eigen::Vector2d rotor(const Trajectory& t, std::size_t row) {
  return {t.column("rotor_x")[row], t.column("rotor_y")[row]};
}

Trajectory run(const scene::Scene& scene, double step) {
  return test::run_with(scene, scene::Integrator::kMidpoint, step);
}

TEST(MidpointBilliard, KeepsSpeedAndAngularMomentumToRoundOff) {
  const Trajectory t = run(shipped("bench_billiard"), 1e-5);
  ASSERT_EQ(t.status, Status::kOk);
  const double constant = 1e-12;  // 20,000 steps of round-off
  const auto momentum = [&](std::size_t k) {
    return t.column("rotor_x")[k] * t.column("rotor_vy")[k] -
           t.column("rotor_y")[k] * t.column("rotor_vx")[k];
  };
  const double speed = 0.5, start = momentum(0);
  for (std::size_t k = 0; k < t.rows(); ++k) {
    ASSERT_NEAR(std::hypot(t.column("rotor_vx")[k], t.column("rotor_vy")[k]), speed,
                constant * speed);
    ASSERT_NEAR(momentum(k), start, constant * std::abs(start));
  }
}

TEST(MidpointBilliard, ConvergesToTheChords) {
  const scene::Scene scene = shipped("bench_billiard");
  const oracle::Billiard exact(0.5e-3, {1e-4, 0.0}, {0.3, 0.4});
  // Before the fourth impact; later the early impacts of a whole flight have added up.
  const double until = 0.005;
  double last = 1.0;
  for (const double step : {1e-4, 1e-5, 1e-6}) {
    const Trajectory t = run(scene, step);
    double error = 0.0;
    for (std::size_t k = 0; t.column("t")[k] <= until; ++k) {
      error = std::max(error, (rotor(t, k) - exact.position(t.column("t")[k])).norm());
    }
    EXPECT_LT(error, 2.0 * 0.5 * step * 3) << "a step of flight for each impact";
    EXPECT_LT(error, 0.5 * last);
    last = error;
  }
  EXPECT_EQ(exact.impacts_until(0.2), 101);
}

TEST(MidpointDrop, BouncesToRest) {
  const Trajectory t = run(shipped("bench_drop"), 1e-6);
  const oracle::Drop exact{0.5e-3, 9.81, 0.5};
  for (int k = 0; k < 3; ++k) {  // each bounce starts up to a step off and adds its own
    EXPECT_NEAR(t.impacts[static_cast<std::size_t>(k)].t, exact.impact_time(k), (k + 1) * 3e-6);
  }
  const std::size_t last = t.rows() - 1;
  EXPECT_NEAR(t.column("rotor_y")[last], -0.5e-3, 1e-12);
  EXPECT_NEAR(t.column("rotor_vy")[last], 0.0, 1e-12);
  EXPECT_NEAR(t.column("normal_force")[last], 19.62, 1e-5);
  EXPECT_EQ(static_cast<Mode>(t.column("mode")[last]), Mode::kStick) << "at rest without spin";
}

// A rotor started on the exact rub stays on it, and its force is the closed form's.
TEST(MidpointAnnularRub, HoldsTheClosedFormOnAFixedRing) {
  const Jeffcott j{
      .mass = 2.0, .damping = 40.0, .stiffness = 2e5, .friction = 0.15, .speed = 300.0};
  const double load = 150.0, frequency = 100.0 * std::numbers::pi;
  const auto exact = oracle::annular_rub({j.mass, j.damping, j.stiffness}, j.clearance, j.friction,
                                         load, frequency);
  ASSERT_TRUE(exact);
  scene::Scene scene = make_scene(j);
  test::add_rotating_force(scene, load, frequency);
  const std::complex<double> v = std::complex<double>(0.0, frequency) * exact->rotor;
  scene.initial.x = {exact->rotor.real()};
  scene.initial.y = {exact->rotor.imag()};
  scene.initial.vx = {v.real()};
  scene.initial.vy = {v.imag()};
  scene.run.end = 0.2;
  const Trajectory t = run(scene, 1e-5);
  EXPECT_EQ(t.contact_fraction(), 1.0);
  // (v_t h)^2 / (2 delta_0) of curvature a step and h of phase: far below 1e-6 at 1e-5.
  EXPECT_NEAR(t.column("normal_force").back(), exact->force, 1e-6 * exact->force);
  const std::complex<double> z = exact->rotor * std::polar(1.0, frequency * scene.run.end);
  const double second_order = std::pow(frequency * 1e-5, 2);  // (Om h)^2, of phase
  EXPECT_NEAR(t.column("rotor_x").back(), z.real(), second_order * j.clearance);
  EXPECT_NEAR(t.column("rotor_y").back(), z.imag(), second_order * j.clearance);
}

TEST(MidpointAnnularRub, SettlesOnTheClosedFormOnAnElasticRing) {
  scene::Scene scene = shipped("bench_ring");
  const auto exact = oracle::annular_rub({2.0, 40.0, 2e5}, {1.0, 200.0, 1e5}, 0.5e-3, 0.15, 150.0,
                                         100.0 * std::numbers::pi);
  ASSERT_TRUE(exact);
  EXPECT_NEAR(exact->force, 121.7020407, 1e-6) << "the published figure";
  const Trajectory t = run(scene, 1e-5);
  EXPECT_NEAR(t.column("normal_force").back(), exact->force, 1e-6 * exact->force);
}

// Published positions at 0.02 s and 0.5 s (two independent solvers, 1e-13).
TEST(MidpointBenchRing, ConvergesAtFirstOrderToThePublishedStates) {
  scene::Scene scene = shipped("bench_ring");
  scene.run.output_times = {0.02};
  const Eigen::Vector2d early{3.200529602935e-4, -1.197270224039e-3};
  const Eigen::Vector2d late{5.15768981628e-4, -2.036936721118e-3};
  double coarse = 0.0, finest = 0.0;
  for (const double step : {1e-4, 1e-5, 1e-6}) {
    const Trajectory t = run(scene, step);
    const auto& times = t.column("t");
    const auto at =
        static_cast<std::size_t>(std::find(times.begin(), times.end(), 0.02) - times.begin());
    const double error = (rotor(t, at) - early).norm();
    EXPECT_LT(error, 0.05 * step) << "5e-7 m at 1e-5";
    EXPECT_LT((rotor(t, t.rows() - 1) - late).norm(), 0.05 * step);
    if (step == 1e-4) coarse = error;
    finest = error;
  }
  EXPECT_LT(finest, 0.05 * coarse) << "two decades of step, nearly two of error";
}

TEST(MidpointWhip, GrowsAsTheRiccatiEquation) {
  const Jeffcott j{.mass = 2.0, .damping = 5.0, .stiffness = 2e5, .friction = 0.2, .speed = 2000.0};
  const oracle::BackwardWhip exact{j.mass, j.damping, j.stiffness, j.friction, j.clearance};
  const double start = 1.3 * exact.growth_threshold();
  scene::Scene scene = make_scene(j);
  scene.initial.x = {j.clearance};
  scene.initial.vy = {-start * j.clearance};
  scene.run.end = 0.5 * exact.blow_up(start);
  const Trajectory t = run(scene, 1e-6);
  const double nu = -t.column("rotor_vy").back() * t.column("rotor_x").back() +
                    t.column("rotor_vx").back() * t.column("rotor_y").back();
  EXPECT_NEAR(nu / (j.clearance * j.clearance) / exact.whirl_speed(start, scene.run.end), 1.0,
              2e-3);
}

TEST(MidpointStepperRefuses, AStepBeyondTheStabilityLimit) {
  scene::Scene scene = make_scene({.mass = 1e-3, .stiffness = 1e9});
  const Trajectory t = run(scene, 1e-4);
  EXPECT_EQ(t.status, Status::kStepTooLarge);
  EXPECT_NE(t.message.find("the stiffest bending mode"), std::string::npos);
}

// v dt > delta_0: the ring is left by no more than the step's own flight, and found again.
TEST(MidpointStepper, RecoversFromAStepLongerThanTheClearance) {
  scene::Scene scene =
      make_scene({.mass = 1.0, .friction = 0.3, .restitution = 0.5, .speed = 500.0});
  scene.initial.vx = {30.0};
  scene.initial.vy = {7.0};
  scene.run.end = 0.05;
  const Trajectory t = run(scene, 1e-4);  // 3 mm a step in a clearance of 0.5 mm
  ASSERT_EQ(t.status, Status::kOk);
  for (const double gap : t.column("gap")) EXPECT_GT(gap, -3.2e-3);
  // Rolling at 25 m/s, the circle is left by no more than half a step of flight.
  EXPECT_GT(t.column("gap").back(), -0.5 * 25.0 * 1e-4);
}

}  // namespace
}  // namespace rotorub
