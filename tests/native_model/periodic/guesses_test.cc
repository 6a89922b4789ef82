// Motions to which runs settle, of machines without closed forms: each comes back to itself when it
// is run for several of its periods.
#include <gtest/gtest.h>

#include <numbers>

#include "native_model/periodic/period_figures.h"
#include "native_model/prepare/prepare.h"
#include "tests/native_model/periodic/first_guesses.h"
#include "tests/support/native_run.h"

namespace rotorub::periodic {
namespace {

// The motion that a run of the model settles to, checked by a run over three of its periods.
PeriodicMotion settled(const Model& model, double duration) {
  const FoundGuess guess = guess_from_run(model, duration);
  EXPECT_EQ(guess.status, Status::kOk) << guess.message;
  const PeriodicMotion found = find_periodic_motion(model, guess.guess);
  EXPECT_TRUE(found.found()) << found.message;
  EXPECT_TRUE(found.stable);
  const MotionRecord later = record_motion(model, found.start, found.start.t + 3.0 * found.period);
  EXPECT_EQ(later.status, Status::kOk) << later.message;
  const int n = model.nq();
  for (int i = 0; i < model.layout.ring_angle(); ++i) {
    if (i == model.layout.phi() && model.layout.spin) continue;
    const double size = found.start.q.cwiseAbs().maxCoeff();
    EXPECT_NEAR(later.end[static_cast<std::size_t>(i)], found.start.q[i], 1e-8 * size);
    const double speed = found.start.v.cwiseAbs().maxCoeff();
    EXPECT_NEAR(later.end[static_cast<std::size_t>(n + i)], found.start.v[i], 1e-8 * speed);
  }
  return found;
}

// Weight breaks the symmetry of the whip, which nevertheless repeats once a whirl.
TEST(Guesses, AWhipUnderWeight) {
  const Model model = prepare(test::shipped("bench_whip", {"gravity.acceleration=[0.0, -9.81]"}));
  const PeriodicMotion found = settled(model, 0.4);
  const ContactFigures figures = period_figures(model, found).contacts[0];
  EXPECT_NEAR(figures.whirl * found.period, -2.0 * std::numbers::pi, 1e-6);
  EXPECT_GT(figures.largest_force, figures.mean_force + 1.0);
}

// The shaft winds up while it sticks to the ring, and then slips. Sticking and slipping repeat with
// the period of the motion.
TEST(Guesses, StickSlipWithFallingFriction) {
  const Model model = prepare(test::shipped("falling_friction"));
  const PeriodicMotion found = settled(model, 0.5);
  const ContactFigures figures = period_figures(model, found).contacts[0];
  EXPECT_GT(figures.stuck_share, 0.3);
  EXPECT_LT(figures.stuck_share, 0.7);
  EXPECT_NEAR(figures.whirl, 0.0, 1e-6);
}

TEST(Guesses, ACompliantRub) { settled(prepare(test::shipped("compliant_ring")), 0.2); }

// A shaft on two rings under weight and unbalance, at 12,000 rpm, both contacts sliding.
TEST(Guesses, AShaftInTwoRingsNightly) {
  const Model model = prepare(test::shipped("two_catchers"));
  const PeriodicMotion found = settled(model, 1.5);
  EXPECT_EQ(found.held.size(), 2u);
  EXPECT_EQ(found.multipliers.size(), 36u);
}

}  // namespace
}  // namespace rotorub::periodic
