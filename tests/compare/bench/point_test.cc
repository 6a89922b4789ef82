// The metrics of a point on made-up trajectories whose answers are known.
#include "compare/bench/point.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/compare/hand_made.h"

namespace rotorub::bench {
namespace {

using test::hand_made;
using test::Row;
using test::sliding;
using test::Whirl;

constexpr std::size_t kRows = 1001;
constexpr double kSpacing = 1e-3;  // s
constexpr double kRoundOff = 1e-15;

Reference reference_of(const Trajectory& trajectory) {
  Reference r;
  r.trajectory = trajectory;
  r.times = trajectory.column("t");
  return r;
}

Trajectory rub(const Whirl& w) {
  Trajectory t = hand_made(kRows, kSpacing, [&](double time) { return sliding(w, time); });
  t.statistics.impulse_total = w.normal * t.end;
  return t;
}

void shift(Trajectory& t, const std::string& name, std::size_t row, double by) {
  for (Column& column : t.series) {
    if (column.name == name) column.values[row] += by;
  }
}

// The largest of all rows and of both bodies, by Pythagoras.
TEST(PointErrors, PositionIsTheLargestDistanceOfEitherBody) {
  const Reference exact = reference_of(rub({}));
  Trajectory off = exact.trajectory;
  EXPECT_EQ(point_errors(off, exact).position, 0.0);
  shift(off, "rotor_x", 17, 3e-6);
  shift(off, "rotor_y", 17, -4e-6);
  shift(off, "stator_y", 40, 2e-6);
  EXPECT_NEAR(point_errors(off, exact).position, 5e-6, kRoundOff);
  shift(off, "stator_x", 1000, -7e-6);
  EXPECT_NEAR(point_errors(off, exact).position, 7e-6, kRoundOff);
}

TEST(PointErrors, ForceIsTheMeanDeviationOverLastingContact) {
  const Whirl w;
  // Free for the first half: what is said of the force there does not count.
  const auto half = [&](double factor, double before) {
    return hand_made(kRows, kSpacing, [&, factor, before](double t) {
      Row row = sliding(w, t);
      row.normal = t < 0.5 ? before : factor * w.normal;
      return row;
    });
  };
  const Reference exact = reference_of(half(1.0, 0.0));
  EXPECT_NEAR(*point_errors(half(1.02, 0.0), exact).force, 0.02, 1e-12);
  EXPECT_NEAR(*point_errors(half(0.97, 55.0), exact).force, 0.03, 1e-12);
  // Chatter has the right mean and is wrong all the same.
  int row = 0;
  const Trajectory chatter = hand_made(kRows, kSpacing, [&](double t) {
    Row r = sliding(w, t);
    r.normal = t < 0.5 ? 0.0 : (++row % 2) * 2.0 * w.normal;
    return r;
  });
  EXPECT_NEAR(*point_errors(chatter, exact).force, 1.0, 1e-12);
}

TEST(PointErrors, ThereIsNoShareOfNothing) {
  Trajectory still = hand_made(kRows, kSpacing, [](double) { return Row{}; });
  const PointErrors e = point_errors(still, reference_of(still));
  EXPECT_EQ(e.position, 0.0);
  EXPECT_FALSE(e.force);
  EXPECT_FALSE(e.impulse);
}

TEST(PointErrors, ImpulseIsAShareOfTheReferences) {
  const Reference exact = reference_of(rub({}));
  Trajectory off = exact.trajectory;
  off.statistics.impulse_total *= 0.9;
  EXPECT_NEAR(*point_errors(off, exact).impulse, 0.1, 1e-12);
}

// Penetration, its prediction and the balance of the energy go through Metrics.
TEST(PointMetrics, PenetrationItsPredictionAndEnergy) {
  const Whirl w;
  Trajectory t = rub(w);
  t.step = 1e-5;
  t.statistics.max_penetration = 3e-9;
  t.statistics.energy_start = 1.0;
  t.statistics.energy_end = 1.5;
  t.statistics.external_work = 0.7;
  t.statistics.contact_work = -0.1;
  t.statistics.energy_scale = 2.0;
  const Metrics m = metrics(t, ContactFacts{w.clearance, w.radius, w.friction});
  EXPECT_EQ(m.max_penetration, 3e-9);
  const double way = w.frequency * w.clearance * t.step;
  EXPECT_NEAR(m.whirl_penetration, way * way / (2.0 * w.clearance), 1e-20);
  EXPECT_NEAR(m.energy_residual, 0.05, 1e-12) << "|1.5 - 1 - 0.6| / 2";
  EXPECT_LT(m.residuals.complementarity, 1e-12);
}

Judgement judged(const Trajectory& t, const Trajectory& reference) {
  return judge(t, settled(t), settled(reference), Whirl{}.clearance);
}

TEST(Judgement, SameAttractorIsFine) {
  const Judgement j = judged(rub({}), rub({}));
  EXPECT_EQ(j.outcome, Outcome::kOk);
  EXPECT_EQ(j.reason, "");
}

TEST(Judgement, BouncingWhereTheReferenceRubsIsChatter) {
  const Trajectory bounces = hand_made(kRows, kSpacing, [](double t) {
    Row row = sliding({}, t);
    if (static_cast<int>(std::lround(t / kSpacing)) % 2 == 0) row.normal = 0.0;
    return row;
  });
  const Judgement j = judged(bounces, rub({}));
  EXPECT_EQ(j.outcome, Outcome::kChatter);
  EXPECT_NE(j.reason.find("chattering"), std::string::npos) << j.reason;
  EXPECT_NE(j.reason.find("synchronous rub"), std::string::npos) << j.reason;
  EXPECT_EQ(judged(bounces, bounces).outcome, Outcome::kOk) << "a scene that bounces for good";
}

TEST(Judgement, AnotherAttractorIsWrong) {
  Whirl rolling;
  rolling.frequency = -rolling.spin_speed * rolling.radius / rolling.clearance;
  EXPECT_EQ(judged(rub(rolling), rub({})).outcome, Outcome::kWrongAttractor);
}

// Two whips have one name.
TEST(Judgement, AnotherFrequencyOfTheSameNameIsWrong) {
  Whirl whip, faster;
  whip.frequency = -500.0;
  faster.frequency = -500.0 * (1.0 + 1.5 * kWhirlTolerance);
  EXPECT_EQ(judged(rub(faster), rub(whip)).outcome, Outcome::kWrongAttractor);
  faster.frequency = -500.0 * (1.0 + 0.5 * kWhirlTolerance);
  EXPECT_EQ(judged(rub(faster), rub(whip)).outcome, Outcome::kOk);
}

TEST(Judgement, AnEarlyEndSaysWhyAndWhen) {
  Trajectory t = rub({});
  t.status = Status::kDiverged;
  t.end = 0.25;
  t.message = "the state is no longer finite";
  const Judgement j = judge(t, {}, settled(rub({})), Whirl{}.clearance);
  EXPECT_EQ(j.outcome, Outcome::kDiverged);
  EXPECT_NE(j.reason.find("0.25"), std::string::npos) << j.reason;
  EXPECT_NE(j.reason.find("no longer finite"), std::string::npos) << j.reason;
  t.status = Status::kStepTooLarge;
  EXPECT_EQ(judge(t, {}, settled(rub({})), Whirl{}.clearance).outcome, Outcome::kRefused);
}

// A soft contact that has let the rotor go says `ok` itself.
TEST(Judgement, ARotorFarOutsideHasDiverged) {
  Trajectory t = rub({});
  t.statistics.max_penetration = 9.0 * Whirl{}.clearance;
  EXPECT_EQ(judged(t, rub({})).outcome, Outcome::kOk) << "deep, but there";
  t.statistics.max_penetration = 11.0 * Whirl{}.clearance;
  EXPECT_EQ(judged(t, rub({})).outcome, Outcome::kDiverged);
  EXPECT_NE(judged(t, rub({})).reason.find("deep"), std::string::npos);
}

TEST(Point, CostIsThatOfTheMedian) {
  Point p;
  p.steps = 50000;
  p.end = 0.5;
  p.wall = {0.1, 0.09, 0.2, 20};
  EXPECT_NEAR(p.us_per_step(), 2.0, 1e-12);
  EXPECT_NEAR(p.real_time_factor(), 5.0, 1e-12);
  EXPECT_EQ(Point{}.us_per_step(), 0.0) << "not timed";
  EXPECT_EQ(Point{}.real_time_factor(), 0.0);
}

}  // namespace
}  // namespace rotorub::bench
