// Periodic motions against closed forms.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "native_model/control/quadratic.h"
#include "native_model/linear/rub_map.h"
#include "native_model/model/linear_plant.h"
#include "native_model/oracles/annular_rub.h"
#include "native_model/periodic/period_figures.h"
#include "native_model/periodic/periodic_motion.h"
#include "native_model/prepare/prepare.h"
#include "native_model/prepare/repeating_model.h"
#include "tests/native_model/periodic/bounce_once_a_turn.h"
#include "tests/native_model/periodic/first_guesses.h"
#include "tests/native_model/periodic/sampled_ring.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/whip.h"

namespace rotorub::periodic {
namespace {

using Complex = std::complex<double>;

// Each multiplier e^{s T} of the eigenvalues s (rad/s) in the whirling frame is among those of the
// motion: seen from the frame at rest after a whole turn, the frame has come back.
void expect_multipliers(const PeriodicMotion& motion, const std::vector<Complex>& eigenvalues,
                        double tolerance) {
  ASSERT_EQ(motion.multipliers.size(), eigenvalues.size());
  for (const Complex& s : eigenvalues) {
    const Complex expected = std::exp(s * motion.period);
    double nearest = 1e300;
    for (const Complex& m : motion.multipliers) nearest = std::min(nearest, std::abs(m - expected));
    EXPECT_LT(nearest, tolerance * std::max(1.0, std::abs(expected))) << s;
  }
}

TEST(PeriodicMotion, ASynchronousRubOnAnElasticRing) {
  const scene::Scene scene = test::shipped("bench_annular_elastic");
  const Model model = prepare(scene);
  Guess guess{initial_state(model), kTurn / scene.forces[0].frequency, 0, {}};
  guess.held.push_back({0, Constraint::Velocity::kTangential});
  guess.start.q[0] *= 1.02;
  const PeriodicMotion found = find_periodic_motion(model, guess);
  ASSERT_TRUE(found.found()) << found.message;
  EXPECT_LE(found.residual, 1e-10);

  const rub::RubSystem system = rub::rub_system(scene);
  const rub::SteadyRub rub = rub::forced_rubs(system, rub::rotating_loads(system)[0])[0];
  const Complex r = rub.rotor[0] * std::polar(1.0, rub.direction);
  EXPECT_NEAR(found.start.q[0], r.real(), 1e-8 * std::abs(r));
  EXPECT_NEAR(found.start.q[1], r.imag(), 1e-8 * std::abs(r));
  expect_multipliers(found, rub::rub_eigenvalues(system, rub), 1e-9);
  EXPECT_TRUE(found.stable);

  const PeriodFigures figures = period_figures(model, found);
  EXPECT_NEAR(figures.contacts[0].mean_force, rub.normal_force, 1e-8 * rub.normal_force);
  EXPECT_NEAR(figures.contacts[0].largest_force, rub.normal_force, 1e-8 * rub.normal_force);
  EXPECT_NEAR(figures.contacts[0].whirl, scene.forces[0].frequency, 1e-8);
  EXPECT_NEAR(figures.contacts[0].amplitude, std::abs(r), 1e-8 * std::abs(r));
  EXPECT_EQ(figures.contacts[0].contact_share, 1.0);
  EXPECT_EQ(figures.contacts[0].impacts, 0);
}

TEST(PeriodicMotion, BlacksWhips) {
  const scene::Scene scene = test::shipped("bench_whip");
  const rub::RubSystem system = rub::rub_system(scene);
  const std::vector<rub::SteadyRub> whips = rub::BackwardCompliance(system).whips(system.friction);
  ASSERT_EQ(whips.size(), 3u);
  for (const rub::SteadyRub& whip : whips) {
    SCOPED_TRACE(whip.whirl);
    const double pace = -1.002 * whip.whirl;
    const Model model = make_model(test::whirling(scene, pace));
    const FoundGuess begun = guess_at_start(model);
    ASSERT_EQ(begun.status, Status::kOk) << begun.message;
    EXPECT_NEAR(begun.guess.period, kTurn / pace, 1e-3 * kTurn / pace);
    const PeriodicMotion found = find_periodic_motion(model, begun.guess);
    ASSERT_TRUE(found.found()) << found.message;
    EXPECT_NEAR(kTurn / found.period, -whip.whirl, -1e-8 * whip.whirl);
    const std::vector<Complex> eigenvalues = rub::rub_eigenvalues(system, whip);
    expect_multipliers(found, eigenvalues, 1e-9);
    EXPECT_EQ(found.stable, rub::stability_of(eigenvalues).stable);
    const ContactFigures figures = period_figures(model, found).contacts[0];
    EXPECT_NEAR(figures.mean_force, whip.normal_force, 1e-8 * whip.normal_force);
    EXPECT_NEAR(figures.whirl, whip.whirl, 1e-7);
  }
}

// The spin is so slow that rolling is a whirl for which friction 0.2 suffices.
TEST(PeriodicMotion, Rolling) {
  scene::Scene scene = test::shipped("bench_whip");
  const double pace = 450.0;
  scene.rotor.speed = pace * scene.first().contact->clearance / scene.first().contact->radius;
  const rub::RubSystem system = rub::rub_system(scene);
  const auto rolling = rub::BackwardCompliance(system).rolling(0.2);
  ASSERT_TRUE(rolling);
  scene = test::whirling(scene, pace);
  const Model model = make_model(scene);
  Guess guess{initial_state(model), 1.01 * kTurn / pace, 0, {}};
  guess.held.push_back({0, Constraint::Velocity::kZero});
  guess.start.q[0] += 2e-5;
  const PeriodicMotion found = find_periodic_motion(model, guess);
  ASSERT_TRUE(found.found()) << found.message << found.residual;
  EXPECT_NEAR(kTurn / found.period, pace, 1e-8 * pace);
  // Each eigenvalue of the complex system is one whirl; as a real system it has the conjugates too.
  std::vector<Complex> eigenvalues = rub::rub_eigenvalues(system, *rolling);
  for (const Complex& s : std::vector<Complex>(eigenvalues)) eigenvalues.push_back(std::conj(s));
  expect_multipliers(found, eigenvalues, 1e-9);
  const ContactFigures figures = period_figures(model, found).contacts[0];
  EXPECT_NEAR(figures.mean_force, rolling->normal_force, 1e-8 * rolling->normal_force);
  EXPECT_EQ(figures.stuck_share, 1.0);
}

TEST(PeriodicMotion, ABounceOnceATurn) {
  const test::BounceOnceATurn bounce;
  const double delta = bounce.clearance, period = bounce.period(), w = bounce.approach();
  scene::Scene scene = bounce.scene();
  scene.initial.x = {1.02 * bounce.x()};
  scene.initial.y = {1e-6};
  const Model model = prepare(scene);
  const FoundGuess begun = guess_at_start(model);
  ASSERT_EQ(begun.status, Status::kOk) << begun.message;
  EXPECT_NEAR(begun.guess.period, period, 1e-15);
  const PeriodicMotion found = find_periodic_motion(model, begun.guess);
  ASSERT_TRUE(found.found()) << found.message;
  EXPECT_NEAR(found.start.q[0], bounce.x(), 1e-8 * delta);
  EXPECT_NEAR(found.start.q[1], 0.0, 1e-8 * delta);
  EXPECT_NEAR(found.start.v[0], bounce.v(), 1e-8 * w);
  const auto expect_pair = [&](double sum, double product) {
    const Complex root = std::sqrt(Complex(0.25 * sum * sum - product));
    for (const Complex& expected : {0.5 * sum + root, 0.5 * sum - root}) {
      double nearest = 1e300;
      for (const Complex& m : found.multipliers)
        nearest = std::min(nearest, std::abs(m - expected));
      EXPECT_LT(nearest, 1e-8) << expected;
    }
  };
  const double eps = bounce.restitution;
  expect_pair((1.0 + eps) * bounce.acceleration() * period / w - 2.0 * eps, eps * eps);
  expect_pair(2.0 - (1.0 + eps) * w * period / delta, 1.0);
  const ContactFigures figures = period_figures(model, found).contacts[0];
  EXPECT_EQ(figures.impacts, 1);
  EXPECT_NEAR(figures.largest_impulse, bounce.press * period, 1e-8 * bounce.press * period);
  EXPECT_NEAR(figures.mean_force, bounce.press, 1e-8 * bounce.press);
  EXPECT_EQ(figures.contact_share, 0.0);
}

// The spin is free and its angle has no effect; the motor holds the speed against friction.
TEST(PeriodicMotion, ARunOfTheBenchRingSettlesToItsRub) {
  const scene::Scene scene = test::shipped("bench_ring");
  const Model model = prepare(scene);
  const FoundGuess settled = guess_from_run(model, 0.06);
  ASSERT_EQ(settled.status, Status::kOk) << settled.message;
  const PeriodicMotion found = find_periodic_motion(model, settled.guess);
  ASSERT_TRUE(found.found()) << found.message;
  EXPECT_TRUE(found.stable);
  const auto rub = oracle::annular_rub({2.0, 40.0, 2e5}, {1.0, 200.0, 1e5}, 0.5e-3, 0.15, 150.0,
                                       scene.forces[0].frequency);
  ASSERT_TRUE(rub);
  const ContactFigures figures = period_figures(model, found).contacts[0];
  EXPECT_NEAR(figures.mean_force, rub->force, 1e-8 * rub->force);
  const double torque = 0.15 * 0.05 * rub->force;  // N m, of friction
  EXPECT_NEAR(found.start.v[2], scene.drive->speed - torque / 0.5, 1e-8 * scene.drive->speed);
}

// Without contact x_{k+1} = (A - B K) x_k plus the load; the held command follows from x_k.
TEST(PeriodicMotion, ASampledLqrHasTheMultipliersOfItsClosedLoop) {
  const scene::Scene scene = test::sampled_ring({"controller.kind=\"lqr\""}, 2.0);
  const Model given = prepare(scene), model = repeating_model(scene, given, prepare);
  const QuadraticDesign d = quadratic_design(scene, 0, plant_of(given, 0, scene.rotor.speed));
  const Eigen::MatrixXd of_sample = d.plant.a - d.plant.b * d.gain;
  Eigen::MatrixXd of_turn = Eigen::MatrixXd::Identity(8, 8);
  for (int k = 0; k < 100; ++k) of_turn = (of_sample * of_turn).eval();

  const FoundGuess begun = guess_from_run(model, 0.2);
  ASSERT_EQ(begun.status, Status::kOk) << begun.message;
  const PeriodicMotion found = find_periodic_motion(model, begun.guess);
  ASSERT_TRUE(found.found()) << found.message;
  EXPECT_TRUE(found.stable);
  EXPECT_EQ(found.multipliers.size(), 10u) << "eight states and two held commands";
  for (const Complex& expected : of_turn.eigenvalues()) {
    double nearest = 1e300;
    for (const Complex& m : found.multipliers) nearest = std::min(nearest, std::abs(m - expected));
    EXPECT_LT(nearest, 1e-9) << expected;
  }
  EXPECT_GT(std::abs(found.multipliers[0]), 1e-3);
}

TEST(PeriodicMotion, RefusesWhatDoesNotRepeat) {
  scene::Scene scene = test::make_scene({.mass = 2.0, .damping = 40.0, .stiffness = 2e5});
  test::add_rotating_force(scene, 10.0, 100.0);
  test::add_rotating_force(scene, 10.0, 100.0 * std::numbers::sqrt2);
  const Model model = prepare(scene);
  const PeriodicMotion found = find_periodic_motion(model, {initial_state(model), 0.0628, 0, {}});
  EXPECT_EQ(found.status, SearchStatus::kRefused);
  EXPECT_NE(found.message.find("no common period"), std::string::npos) << found.message;
}

}  // namespace
}  // namespace rotorub::periodic
