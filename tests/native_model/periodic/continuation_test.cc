// Branches of periodic motions, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <numbers>
#include <vector>

#include "native_model/linear/rub_map.h"
#include "native_model/periodic/continuation.h"
#include "native_model/periodic/period_figures.h"
#include "native_model/prepare/prepare.h"
#include "tests/native_model/periodic/bounce_once_a_turn.h"
#include "tests/native_model/periodic/first_guesses.h"
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

TEST(Continuation, OfABounceBetweenItsFoldAndItsPeriodDoubling) {
  const test::BounceOnceATurn bounce;
  // The first start is the closed form's, the others are searched for.
  const auto model_at = [&](double swing) {
    scene::Scene scene = bounce.scene();
    scene.forces[1].amplitude = scene.forces[2].amplitude = 0.5 * swing;
    return prepare(scene);
  };
  const Model model = model_at(bounce.swing);
  const PeriodicMotion start = find_periodic_motion(model, guess_at_start(model).guess);
  ASSERT_TRUE(start.found()) << start.message;
  ContinuationParameters settings;
  settings.lowest = 5.0;
  settings.highest = 16.0;
  settings.scale = 5.0;
  const Branch up = continue_branch(model_at, bounce.swing, start, settings);
  EXPECT_TRUE(up.points.front().motion.stable);
  EXPECT_FALSE(up.points.back().motion.stable);
  const auto doublings = of_kind(up, PointKind::kPeriodDoubling);
  ASSERT_EQ(doublings.size(), 1u) << up.end;
  EXPECT_NEAR(doublings[0].parameter, bounce.doubling_swing(), 1e-7);
  settings.direction = -1.0;
  settings.highest = 13.0;
  const Branch down = continue_branch(model_at, bounce.swing, start, settings);
  EXPECT_FALSE(down.points.back().motion.stable);
  const auto folds = of_kind(down, PointKind::kFold);
  ASSERT_EQ(folds.size(), 1u) << down.end;
  EXPECT_NEAR(folds[0].parameter, bounce.least_swing(), 1e-7);
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

}  // namespace
}  // namespace rotorub::periodic
