// Branches of periodic motions, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "native_model/linear/rub_map.h"
#include "native_model/periodic/continuation.h"
#include "native_model/periodic/period_figures.h"
#include "native_model/periodic/settled_motion.h"
#include "native_model/prepare/prepare.h"
#include "native_model/prepare/repeating_model.h"
#include "tests/native_model/periodic/bounce_once_a_turn.h"
#include "tests/native_model/periodic/first_guesses.h"
#include "tests/native_model/periodic/sampled_ring.h"
#include "tests/support/native_run.h"
#include "tests/support/whip.h"

namespace rotorub::periodic {
namespace {

Model whip_with(double friction) {
  scene::Scene scene = test::shipped("bench_whip");
  scene.first().contact->friction = friction;
  return make_model(test::whirling(scene, 502.0));
}

PeriodicMotion whip_at(double friction) {
  const Model model = whip_with(friction);
  const FoundGuess begun = guess_at_start(model);
  EXPECT_EQ(begun.status, Status::kOk) << begun.message;
  const PeriodicMotion found = find_periodic_motion(model, begun.guess);
  EXPECT_TRUE(found.found()) << found.message;
  return found;
}

std::vector<BranchPoint> of_kind(const Branch& branch, PointKind kind) {
  std::vector<BranchPoint> found;
  std::ranges::copy_if(branch.points, std::back_inserter(found),
                       [kind](const BranchPoint& p) { return p.kind == kind; });
  return found;
}

// Every point of the branch is one of Black's whips at its friction.
void expect_whips(const Branch& branch) {
  const oracle::ElasticWhip whip = test::whip_of(test::shipped("bench_whip"));
  for (const BranchPoint& p : branch.points) {
    EXPECT_NEAR(whip.friction_asked(kTurn / p.motion.period), p.parameter, 1e-8);
  }
}

// Design: the whip begins to exist at the friction 0.15510962126429, with -437.194917 rad/s.
TEST(Continuation, OfTheWhipAroundItsFold) {
  ContinuationParameters settings;
  settings.lowest = 0.1;
  settings.highest = 0.21;
  settings.scale = 0.1;
  settings.direction = -1.0;
  settings.longest_step = 0.3;
  settings.most_points = 60;
  const Branch branch = continue_branch(whip_with, 0.2, whip_at(0.2), settings);
  EXPECT_EQ(branch.end, "the parameter leaves its range");
  const auto folds = of_kind(branch, PointKind::kFold);
  ASSERT_EQ(folds.size(), 1u);
  EXPECT_NEAR(folds[0].parameter, 0.15510962126429, 1e-8);
  EXPECT_NEAR(kTurn / folds[0].motion.period, 437.194917, 1e-5);
  EXPECT_TRUE(branch.points.front().motion.stable);
  EXPECT_FALSE(branch.points.back().motion.stable);
  expect_whips(branch);
}

// Design: the whip loses its stability at the friction 0.242109, where a pair of eigenvalues
// +-1328.89 i crosses the axis at 523.362 rad/s.
TEST(Continuation, OfTheWhipThroughItsHopfBorder) {
  ContinuationParameters settings;
  settings.lowest = 0.1;
  settings.highest = 0.26;
  settings.scale = 0.1;
  settings.longest_step = 0.3;
  const Branch branch = continue_branch(whip_with, 0.2, whip_at(0.2), settings);
  const auto tori = of_kind(branch, PointKind::kTorus);
  ASSERT_EQ(tori.size(), 1u);
  EXPECT_NEAR(tori[0].parameter, 0.242109, 1e-6);
  EXPECT_NEAR(kTurn / tori[0].motion.period, 523.362, 1e-3);
  expect_whips(branch);
  // The same from the eigenvalues of the closed form.
  scene::Scene scene = test::shipped("bench_whip");
  scene.first().contact->friction = tori[0].parameter;
  const rub::RubSystem system = rub::rub_system(scene);
  const auto point = rub::RubStudy(system).at(system.friction);
  EXPECT_NEAR(point.leading(rub::RubKind::kWhip)->stability.growth, 0.0, 1e-6);
}

// The bounce with another swing A. The first start is the closed form's, the others are searched
// for.
Model bounce_with(double swing, double damping = 0.0) {
  scene::Scene scene = test::BounceOnceATurn().scene();
  scene.forces[1].amplitude = scene.forces[2].amplitude = 0.5 * swing;
  scene.rotor.modal->damping = {damping};
  return prepare(scene);
}

// Its branch towards larger swings.
Branch bounces(double damping, const ContinuationParameters& settings) {
  const auto model_at = [damping](double swing) { return bounce_with(swing, damping); };
  const double swing = test::BounceOnceATurn().swing;
  const Model model = model_at(swing);
  const PeriodicMotion start = find_periodic_motion(model, guess_at_start(model).guess);
  EXPECT_TRUE(start.found()) << start.message;
  return continue_branch(model_at, swing, start, settings);
}

ContinuationParameters swings(double lowest, double highest) {
  ContinuationParameters settings;
  settings.lowest = lowest;
  settings.highest = highest;
  settings.scale = 5.0;
  return settings;
}

TEST(Continuation, OfABounceBetweenItsFoldAndItsPeriodDoubling) {
  const test::BounceOnceATurn bounce;
  const Branch up = bounces(0.0, swings(5.0, 16.0));
  EXPECT_TRUE(up.points.front().motion.stable);
  EXPECT_FALSE(up.points.back().motion.stable);
  const auto doublings = of_kind(up, PointKind::kPeriodDoubling);
  ASSERT_EQ(doublings.size(), 1u) << up.end;
  EXPECT_NEAR(doublings[0].parameter, bounce.doubling_swing(), 1e-7);
  ContinuationParameters settings = swings(5.0, 13.0);
  settings.direction = -1.0;
  const Branch down = bounces(0.0, settings);
  EXPECT_FALSE(down.points.back().motion.stable);
  const auto folds = of_kind(down, PointKind::kFold);
  ASSERT_EQ(folds.size(), 1u) << down.end;
  EXPECT_NEAR(folds[0].parameter, bounce.least_swing(), 1e-7);
}

// Expects `count` impacts in a period, with flights in between that are exact. Returns the largest
// difference between their speeds, m/s.
double expect_flights(const BranchPoint& point, std::size_t count) {
  test::BounceOnceATurn bounce;
  bounce.swing = point.parameter;
  const Model model = bounce_with(point.parameter);
  const PeriodicMotion& motion = point.motion;
  const MotionRecord record = record_motion(model, motion.start, motion.start.t + motion.period);
  std::vector<std::pair<double, double>> impacts;  // time, speed
  for (const Stretch& s : record.stretches) {
    const auto vx = static_cast<std::size_t>(model.nq() + model.layout.x());
    if (s.jump) impacts.emplace_back(s.end(), s.jump->before[vx]);
  }
  EXPECT_EQ(impacts.size(), count) << point.parameter;
  if (impacts.empty()) return 0.0;
  impacts.emplace_back(impacts.front().first + motion.period, impacts.front().second);
  double difference = 0.0;
  for (std::size_t k = 0; k + 1 < impacts.size(); ++k) {
    const auto [t, w] = impacts[k];
    const auto [next, w_next] = impacts[k + 1];
    EXPECT_LT(bounce.flight_error(t, w, next, w_next), 1e-9) << point.parameter;
    difference = std::max(difference, std::abs(w - w_next));
  }
  return difference;
}

// The impacts of the rotor scale areas of the phase plane by eps^2 each, and those along the ring
// not at all.
double product_of_multipliers(const PeriodicMotion& motion) {
  std::complex<double> product = 1.0;
  for (const std::complex<double>& m : motion.multipliers) product *= m;
  return product.real();
}

TEST(Continuation, OfABounceThroughTwoPeriodDoublings) {
  const test::BounceOnceATurn bounce;
  const auto model_at = [](double swing) { return bounce_with(swing); };
  const ContinuationParameters settings = swings(5.0, 17.0);
  const auto doublings = of_kind(bounces(0.0, settings), PointKind::kPeriodDoubling);
  ASSERT_EQ(doublings.size(), 1u);
  const Branch two = continue_doubled(model_at, doublings[0], settings);
  ASSERT_GT(two.points.size(), 5u) << two.end;
  EXPECT_NEAR(two.points[0].parameter, bounce.doubling_swing(), 1e-7);
  EXPECT_EQ(two.points[0].kind, PointKind::kPeriodDoubling);
  for (std::size_t k = 0; k < two.points.size(); ++k) {
    const BranchPoint& at = two.points[k];
    EXPECT_NEAR(at.motion.period, 2.0 * bounce.period(), 1e-12);
    const double difference = expect_flights(at, 2);
    EXPECT_NEAR(product_of_multipliers(at.motion), std::pow(bounce.restitution, 4.0), 1e-6);
    if (k == 0) continue;
    EXPECT_GT(difference, 1e-4) << at.parameter;
    EXPECT_GT(at.parameter, bounce.doubling_swing());
  }
  EXPECT_TRUE(two.points[1].motion.stable);
  const auto again = of_kind(two, PointKind::kPeriodDoubling);
  ASSERT_EQ(again.size(), 2u) << "its beginning and the next one; " << two.end;
  ContinuationParameters finer = settings;
  finer.first_step = 0.005;
  finer.longest_step = 0.02;
  const Branch four = continue_doubled(model_at, again[1], finer);
  ASSERT_GT(four.points.size(), 2u) << four.end;
  EXPECT_TRUE(four.points[1].motion.stable);
  for (std::size_t k = 1; k < four.points.size(); ++k) expect_flights(four.points[k], 4);
  EXPECT_TRUE(continue_doubled(model_at, again[0], settings).points.empty())
      << "it has the multiplier 1 and not -1";
}

TEST(Continuation, OfABounceInTwoTurnsEndsAtItsPeriodDoubling) {
  const test::BounceOnceATurn bounce;
  const auto model_at = [](double swing) { return bounce_with(swing); };
  ContinuationParameters settings = swings(5.0, 17.0);
  const auto doublings = of_kind(bounces(0.0, settings), PointKind::kPeriodDoubling);
  ASSERT_EQ(doublings.size(), 1u);
  const Branch two = continue_doubled(model_at, doublings[0], settings);
  ASSERT_GT(two.points.size(), 5u) << two.end;
  settings.direction = -1.0;
  const Branch back =
      continue_branch(model_at, two.points[4].parameter, two.points[4].motion, settings);
  EXPECT_EQ(back.end, "a period doubling of motions of half the period");
  EXPECT_EQ(back.points.back().kind, PointKind::kPeriodDoubling);
  EXPECT_NEAR(back.points.back().parameter, bounce.doubling_swing(), 1e-7);
  for (const BranchPoint& at : back.points) expect_flights(at, 2);
}

// With a little damping a run beyond the period doubling settles on the branch that begins there.
TEST(Continuation, OfABounceInTwoTurnsIsWhereARunSettles) {
  constexpr double kDamping = 0.5;  // N s/m
  const double swing = 1.05 * test::BounceOnceATurn().doubling_swing();
  const auto model_at = [](double of) { return bounce_with(of, kDamping); };
  const ContinuationParameters settings = swings(5.0, swing);
  const auto doublings = of_kind(bounces(kDamping, settings), PointKind::kPeriodDoubling);
  ASSERT_EQ(doublings.size(), 1u);
  const Branch two = continue_doubled(model_at, doublings[0], settings);
  ASSERT_FALSE(two.points.empty()) << two.end;
  EXPECT_EQ(two.end, "the parameter leaves its range");
  const Model model = model_at(swing);
  const PeriodicMotion& last = two.points.back().motion;
  const PeriodicMotion listed =
      find_periodic_motion(model, {last.start, last.period, last.turns, last.held, false});
  ASSERT_TRUE(listed.found()) << listed.message;
  const SettledMotion run = settled_motion(model, initial_state(model), {.duration = 1.0});
  ASSERT_TRUE(run.found()) << run.refusal;
  EXPECT_EQ(run.order, 2);
  const ContactFigures a = period_figures(model, listed).contacts[0],
                       b = period_figures(model, run.motion).contacts[0];
  EXPECT_EQ(a.impacts, 2);
  EXPECT_NEAR(a.largest_impulse, b.largest_impulse, 1e-8 * a.largest_impulse);
  EXPECT_NEAR(a.mean_force, b.mean_force, 1e-8 * a.mean_force);
}

// Design: with the force's frequency as speed the synchronous rub ends at 707.6856016 rad/s.
TEST(Continuation, OfTheSynchronousRubOverTheSpeed) {
  const auto model_at = [](double speed) {
    scene::Scene scene = test::shipped("bench_annular_elastic");
    scene.rotor.speed = scene.forces[0].frequency = speed;
    return make_model(scene);
  };
  const double speed = 100.0 * std::numbers::pi;
  const Model model = model_at(speed);
  const FoundGuess begun = guess_at_start(model);
  ASSERT_EQ(begun.guess.held.size(), 1u);
  const PeriodicMotion start = find_periodic_motion(model, begun.guess);
  ASSERT_TRUE(start.found()) << start.message;
  ContinuationParameters settings;
  settings.lowest = 300.0;
  settings.highest = 800.0;
  settings.scale = 100.0;
  settings.longest_step = 0.3;
  const Branch branch = continue_branch(model_at, speed, start, settings);
  const auto folds = of_kind(branch, PointKind::kFold);
  ASSERT_EQ(folds.size(), 1u) << branch.end;
  EXPECT_NEAR(folds[0].parameter, 707.6856016, 1e-5);
  const Model at_fold = model_at(folds[0].parameter);
  EXPECT_NEAR(period_figures(at_fold, folds[0].motion).contacts[0].mean_force, 128.75786, 1e-2);
}

// The number of samples in a period falls from 104 to 89 along the branch.
TEST(Continuation, OfASampledControllerOverTheSpeed) {
  const std::vector<std::string> law = test::sampled_laws()[2];
  const auto model_at = [&](double speed) {
    scene::Scene scene = test::sampled_ring(law);
    scene.rotor.speed = speed;
    return repeating_model(scene, prepare(scene), prepare);
  };
  const auto settled_at = [&](double speed) {
    const Model model = model_at(speed);
    return settled_motion(model, initial_state(model), {.duration = 0.4});
  };
  ContinuationParameters settings;
  settings.lowest = kTurn * 48.0;
  settings.highest = kTurn * 56.0;
  settings.scale = 10.0;
  settings.longest_step = 1.0;
  const SettledMotion begin = settled_at(settings.lowest);
  ASSERT_TRUE(begin.found()) << begin.refusal;
  const Branch branch = continue_branch(model_at, settings.lowest, begin.motion, settings);
  EXPECT_EQ(branch.end, "the parameter leaves its range");
  const BranchPoint& last = branch.points.back();
  const SettledMotion end = settled_at(last.parameter);
  ASSERT_TRUE(end.found()) << end.refusal;
  const Model model = model_at(last.parameter);
  const double force = period_figures(model, last.motion).contacts[0].mean_force;
  EXPECT_NEAR(force, period_figures(model, end.motion).contacts[0].mean_force, 1e-8 * force);
}

}  // namespace
}  // namespace rotorub::periodic
