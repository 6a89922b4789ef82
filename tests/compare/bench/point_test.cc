#include "compare/bench/point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/compare/hand_made.h"
#include "tests/support/native_run.h"

namespace rotorub::bench {
namespace {

// The metrics of a point on made-up trajectories with known answers.

using test::at_two_contacts;
using test::hand_made;
using test::Row;
using test::sliding;
using test::Whirl;

constexpr std::size_t kRows = 1001;
constexpr double kSpacing = 1e-3;  // s
constexpr double kRoundOff = 1e-15;
const std::vector<ContactFacts> kFacts{ContactFacts{Whirl{}.clearance, Whirl{}.radius}};

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

// The largest error of all rows and of both bodies, by Pythagoras.
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
  // The rotor is free in the first half, whose forces do not count.
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
  // Chatter has the right mean and is wrong nevertheless.
  int row = 0;
  const Trajectory chatter = hand_made(kRows, kSpacing, [&](double t) {
    Row r = sliding(w, t);
    r.normal = t < 0.5 ? 0.0 : (++row % 2) * 2.0 * w.normal;
    return r;
  });
  EXPECT_NEAR(*point_errors(chatter, exact).force, 1.0, 1e-12);
}

// The second contact carries half of the first one's force; there the run is off by 3 um and 2 %.
TEST(PointErrors, CoverEveryContactInAnyOrder) {
  Whirl half, off = half;
  half.normal = 50.0;
  off.normal = 51.0;
  const Trajectory first = rub({}), second = rub(half);
  Trajectory run = rub(off);
  shift(run, "rotor_x", 17, 3e-6);
  const PointErrors one = point_errors(at_two_contacts(first, run),
                                       reference_of(at_two_contacts(first, second))),
                    other = point_errors(at_two_contacts(run, first),
                                         reference_of(at_two_contacts(second, first)));
  for (const PointErrors& e : {one, other}) {
    EXPECT_NEAR(e.position, 3e-6, kRoundOff);
    EXPECT_NEAR(e.force.value(), 1.0 / 150.0, 1e-12);
  }
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

Judgement judged(const Trajectory& t, const Trajectory& reference) {
  return judge(t, settled(t), settled(reference), kFacts);
}

TEST(Judgement, BouncingWhereTheReferenceRubsIsChatter) {
  const Trajectory bounces = hand_made(kRows, kSpacing, [](double t) {
    Row row = sliding({}, t);
    if (static_cast<int>(std::lround(t / kSpacing)) % 2 == 0) row.normal = 0.0;
    return row;
  });
  const Judgement j = judged(bounces, rub({}));
  EXPECT_EQ(j.outcome, Outcome::kChatter);
  EXPECT_NE(j.reason.find("bouncing"), std::string::npos) << j.reason;
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
  const Judgement j = judge(t, {}, settled(rub({})), kFacts);
  EXPECT_EQ(j.outcome, Outcome::kDiverged);
  EXPECT_NE(j.reason.find("0.25"), std::string::npos) << j.reason;
  EXPECT_NE(j.reason.find("no longer finite"), std::string::npos) << j.reason;
  t.status = Status::kStepTooLarge;
  EXPECT_EQ(judge(t, {}, settled(rub({})), kFacts).outcome, Outcome::kRefused);
}

// A soft contact that has let the rotor go reports `ok`.
TEST(Judgement, ARotorFarOutsideHasDiverged) {
  Trajectory t = rub({});
  t.statistics.contacts[0].max_penetration = 9.0 * Whirl{}.clearance;
  EXPECT_EQ(judged(t, rub({})).outcome, Outcome::kOk) << "deep, but there";
  t.statistics.contacts[0].max_penetration = 11.0 * Whirl{}.clearance;
  EXPECT_EQ(judged(t, rub({})).outcome, Outcome::kDiverged);
  EXPECT_NE(judged(t, rub({})).reason.find("deep"), std::string::npos);
}

// Two clearances deep in a wide ring the rotor is still there; twelve deep in a narrow one it is
// gone, at whichever contact.
TEST(Judgement, EachDepthIsJudgedByItsOwnClearance) {
  std::vector<ContactFacts> facts{ContactFacts{2e-3, 0.05}, ContactFacts{0.05e-3, 0.05}};
  Trajectory t = rub({});
  t.statistics.max_penetration = 4e-3;
  t.statistics.contacts.resize(2);
  t.statistics.contacts[0].max_penetration = 4e-3;
  for (const char* order : {"wide ring first", "narrow ring first"}) {
    SCOPED_TRACE(order);
    const std::size_t narrow = facts[0].clearance < facts[1].clearance ? 0 : 1;
    t.statistics.contacts[narrow].max_penetration = 0.4e-3;
    EXPECT_EQ(judge(t, settled(t), settled(t), facts).outcome, Outcome::kOk);
    t.statistics.contacts[narrow].max_penetration = 0.6e-3;
    const Judgement j = judge(t, settled(t), settled(t), facts);
    EXPECT_EQ(j.outcome, Outcome::kDiverged);
    EXPECT_NE(j.reason.find("0.0006 m deep"), std::string::npos) << j.reason;
    std::swap(facts[0], facts[1]);
    std::swap(t.statistics.contacts[0], t.statistics.contacts[1]);
  }
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

const Progress kSilent = [](double, const std::string&) {};

TEST(WallTime, IsMedianLowestHighest) {
  const WallTime odd = wall_time({3.0, 1.0, 2.0});
  EXPECT_EQ(odd.median, 2.0);
  EXPECT_EQ(odd.low, 1.0);
  EXPECT_EQ(odd.high, 3.0);
  EXPECT_EQ(odd.repeats, 3);
  EXPECT_EQ(wall_time({4.0, 1.0, 2.0, 100.0}).median, 3.0) << "one outlier does not move it";
}

TEST(Interleaved, TakesTheJobsInTurns) {
  std::vector<int> order;
  std::vector<WallTime> times;
  std::vector<TimedJob> jobs;
  for (int k = 0; k < 3; ++k) {
    jobs.push_back({[k, &order] {
                      order.push_back(k);
                      return static_cast<double>(order.size());
                    },
                    1e-3, [&times](const WallTime& time) { times.push_back(time); }});
  }
  TimingParameters parameters;
  parameters.repeats = 2;
  interleaved(jobs, parameters, kSilent, nullptr);
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 0, 1, 2}));
  EXPECT_EQ(times[1].low, 2.0);
  EXPECT_EQ(times[1].high, 5.0);
  EXPECT_EQ(times[1].median, 3.5);
}

// Slow jobs are repeated less often, but often enough for a median.
TEST(Interleaved, SlowJobsAreRepeatedLess) {
  const TimingParameters parameters{20, 5, 20.0};
  EXPECT_EQ(repeats_of(1e-3, parameters), 20);
  EXPECT_EQ(repeats_of(1.0, parameters), 20);
  EXPECT_EQ(repeats_of(2.0, parameters), 10);
  EXPECT_EQ(repeats_of(100.0, parameters), 5);
  EXPECT_EQ(repeats_of(100.0, {3, 5, 20.0}), 3) << "never more than asked for";
}

TEST(Interleaved, AnInterruptedRunIsNoTime) {
  std::atomic<bool> interrupt{false};
  std::vector<WallTime> times;
  const auto keep = [&](const WallTime& time) { times.push_back(time); };
  const auto interrupted = [&] {
    interrupt = true;
    return 1e-9;
  };
  interleaved({{[] { return 1.0; }, 1.0, keep}, {interrupted, 1.0, keep}}, {3, 1, 1e9}, kSilent,
              &interrupt);
  EXPECT_EQ(times[0].repeats, 1);
  EXPECT_EQ(times[1].repeats, 0);
}

// ---------------------------------------------------------------- the error pass
class ErrorPass : public testing::Test {
 protected:
  ErrorPass()
      : scene_(std::make_shared<const scene::Scene>(test::shipped("bench_ring", {"run.end=0.02"}))),
        reference_(make_reference(*scene_, rows())) {}

  RunRequest rows() const {
    RunRequest r;
    r.output_times = common_times(scene_->run, {1e-4, 1e-5});
    return r;
  }
  Setting setting(scene::Integrator integrator, double step) const {
    return {"native", "", step, native_engine(integrator), scene_, ""};
  }

  std::shared_ptr<const scene::Scene> scene_;
  Reference reference_;
};

TEST_F(ErrorPass, FinerStepsAreMoreExactAndTheFinestIsTheLimit) {
  const auto points = error_pass(
      {setting(scene::Integrator::kVerlet, 1e-4), setting(scene::Integrator::kVerlet, 5e-5),
       setting(scene::Integrator::kVerlet, 1e-5)},
      reference_, kSilent, nullptr);
  ASSERT_EQ(points.size(), 3u);
  for (const Point& p : points) {
    EXPECT_EQ(p.judgement.outcome, Outcome::kOk) << p.judgement.reason;
    ASSERT_TRUE(p.finished());
    EXPECT_TRUE(p.metrics);
  }
  EXPECT_LT(points[1].errors->position, points[0].errors->position);
  EXPECT_LT(points[2].errors->position, points[1].errors->position);
  EXPECT_FALSE(points[2].limit_error) << "the finest has none to be compared with";
  // The run converges to the reference, so its distance to its own limit is nearly its error.
  EXPECT_NEAR(*points[0].limit_error, points[0].errors->position, 0.1 * points[0].errors->position);
  EXPECT_LT(*points[1].limit_error, *points[0].limit_error);
}

class Throws final : public Engine {
 public:
  std::string name() const override { return "throws"; }
  Trajectory run(const scene::Scene&, const RunRequest&) const override {
    throw std::runtime_error("this engine holds no rotor");
  }
};

// A failure is a point with its reason, and the others continue.
TEST_F(ErrorPass, WhatFailsSaysWhy) {
  Setting refused = setting(scene::Integrator::kVerlet, 1e-5);
  refused.refusal = "no such variant";
  Setting throws = refused;
  throws.refusal = "";
  throws.runner = std::make_shared<Throws>();
  auto points = error_pass({refused, throws, setting(scene::Integrator::kVerlet, 1e-2),
                            setting(scene::Integrator::kVerlet, 1e-5)},
                           reference_, kSilent, nullptr);
  ASSERT_EQ(points.size(), 4u);
  EXPECT_EQ(points[0].judgement.outcome, Outcome::kRefused);
  EXPECT_EQ(points[0].judgement.reason, "no such variant");
  EXPECT_EQ(points[1].judgement.outcome, Outcome::kRefused);
  EXPECT_EQ(points[1].judgement.reason, "this engine holds no rotor");
  EXPECT_EQ(points[2].judgement.outcome, Outcome::kRefused) << "beyond the limit of the step";
  EXPECT_NE(points[2].judgement.reason.find("limit"), std::string::npos)
      << points[2].judgement.reason;
  EXPECT_FALSE(points[2].finished());
  EXPECT_TRUE(points[3].finished());

  timing_pass(points, {2, 1, 1.0}, kSilent, nullptr);
  EXPECT_EQ(points[0].wall.repeats, 0) << "nothing to time";
  EXPECT_EQ(points[2].wall.repeats, 0);
  EXPECT_EQ(points[3].wall.repeats, 2);
  EXPECT_GT(points[3].wall.median, 0.0);
}

}  // namespace
}  // namespace rotorub::bench
