// Rows are written at multiples of the spacing, at the end, and at requested times, exactly there,
// with the documented interpolation.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "native_model/model/dynamics.h"
#include "native_model/prepare/prepare.h"
#include "native_model/trajectory/recorder.h"
#include "tests/support/jeffcott.h"

namespace rotorub {
namespace {

using Path = std::function<Eigen::VectorXd(double)>;

// Without contact, for a model of one or two bearings.
Snapshot snapshot(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  static const ContactSnapshot flight[2];
  return {t, q.data(), v.data(), flight};
}

// Feeds (q, v)(t) at k step for k = 0 .. steps; impact(k) says that step k had one.
Trajectory record(
    const Model& model, std::vector<double> times, double step, int steps, const Path& q,
    const Path& v, const std::function<bool(int)>& impact = [](int) { return false; }) {
  Recorder recorder(model, std::move(times));
  recorder.begin(snapshot(0.0, q(0.0), v(0.0)));
  for (int k = 1; k <= steps; ++k) {
    const Impact none;
    recorder.step(snapshot(k * step, q(k * step), v(k * step)), 0.0, 0.0,
                  impact(k) ? &none : nullptr, {});
  }
  return recorder.finish({steps * step});
}

// One mode in two planes on a cubic and a parabola, mm and ms.
Eigen::VectorXd cubic(double t) {
  const double s = 1e3 * t;
  return 1e-4 * Eigen::Vector2d(1.0 - s + 0.5 * s * s - 0.07 * s * s * s, 0.3 * s * s - s);
}
Eigen::VectorXd cubic_rate(double t) {
  const double s = 1e3 * t;
  return 0.1 * Eigen::Vector2d(-1.0 + s - 0.21 * s * s, 0.6 * s - 1.0);
}

TEST(RecorderRows, AtTheTimesAskedForToTheBit) {
  const Model m = prepare(test::make_scene({}));
  const std::vector<double> times{0.0, 1.0 / 3e3, 0.7e-3, 1.234e-3, std::nextafter(2e-3, 0.0),
                                  5e-3};
  const Trajectory t = record(m, times, 1e-3, 5, cubic, cubic_rate);
  EXPECT_EQ(t.column("t"), times);
  EXPECT_EQ(t.end, 5e-3);
}

TEST(RecorderRows, CubicsAreInterpolatedExactly) {
  const Model m = prepare(test::make_scene({}));
  std::vector<double> times;
  for (int k = 0; k <= 97; ++k) times.push_back(k * 5e-3 / 97);
  const Trajectory t = record(m, times, 1e-3, 5, cubic, cubic_rate);
  ASSERT_EQ(t.rows(), times.size());
  for (std::size_t k = 0; k < times.size(); ++k) {
    EXPECT_NEAR(t.column("rotor_x")[k], cubic(times[k])[0], 1e-18) << times[k];
    EXPECT_NEAR(t.column("y_1")[k], cubic(times[k])[1], 1e-18) << times[k];
    // The parabola's speed is linear.
    EXPECT_NEAR(t.column("rotor_vy")[k], cubic_rate(times[k])[1], 1e-14) << times[k];
  }
}

TEST(RecorderRows, AtAStepItsStateToTheBit) {
  const Model m = prepare(test::make_scene({}));
  // 0.3 is the third step but for round-off.
  const Trajectory t = record(m, {0.1, 0.3}, 0.1, 5, cubic, cubic_rate);
  EXPECT_EQ(t.column("t")[1], 0.3);
  EXPECT_EQ(t.column("x_1")[1], cubic(3 * 0.1)[0]);
  EXPECT_EQ(t.column("vx_1")[1], cubic_rate(3 * 0.1)[0]);
}

TEST(RecorderRows, StraightAcrossAnImpact) {
  const Model m = prepare(test::make_scene({}));
  const auto path = [](double t) { return Eigen::VectorXd(Eigen::Vector2d(1e-4 * t, 0.0)); };
  const auto speed = [](double t) {
    return Eigen::VectorXd(Eigen::Vector2d(t < 1.5 ? 9.0 : -9.0, 0));
  };
  const auto second = [](int k) { return k == 2; };
  const Trajectory t = record(m, {1.25, 1.5, 1.75, 2.25}, 1.0, 3, path, speed, second);
  for (const std::size_t k : {0u, 1u, 2u}) {
    EXPECT_NEAR(t.column("x_1")[k], path(t.column("t")[k])[0], 1e-19) << "no wiggle of the cubic";
  }
  EXPECT_GT(std::abs(t.column("x_1")[3] - path(2.25)[0]), 0.1) << "elsewhere the cubic is back";
}

TEST(RecorderRows, APrescribedSpinTurnsOnByItself) {
  const Model m = prepare(test::make_scene({.speed = 200.0}));
  const Trajectory t = record(m, {0.0, 1.5e-3}, 1e-3, 2, cubic, cubic_rate);
  EXPECT_DOUBLE_EQ(t.column("spin_angle")[1], 0.3);
  EXPECT_EQ(t.column("spin_speed")[1], 200.0);
}

// The gap at the start counts without a row there, at whichever of two contacts it is smaller.
TEST(Recorder, MeetsTheGapOfEveryContactAtTheStart) {
  for (const std::size_t narrow : {0u, 1u}) {
    scene::Scene s = test::make_scene({.clearance = 0.5e-3});
    s.auxiliary.push_back(s.first());
    s.auxiliary[narrow].contact->clearance = 0.3e-3;
    const Model m = prepare(s);
    Recorder recorder(m, {});
    const Eigen::VectorXd q = Eigen::Vector2d(0.25e-3, 0.0), v = Eigen::Vector2d(0.0, 0.0);
    recorder.begin(snapshot(0.0, q, v));
    const Statistics found = recorder.finish({0.0}).statistics;
    EXPECT_NEAR(found.least_gap, 0.05e-3, 1e-18);
    EXPECT_NEAR(found.contacts[narrow].least_gap, 0.05e-3, 1e-18);
    EXPECT_NEAR(found.contacts[1 - narrow].least_gap, 0.25e-3, 1e-18);
  }
}

TEST(Recorder, PutsImpactsAndEventsInOrder) {
  const Model m = prepare(test::make_scene({}));
  Recorder recorder(m, {0.0});
  recorder.add(Impact{.t = 0.2, .normal_impulse = 1.0, .gap_rate_before = -0.5e-4});
  recorder.add(Impact{.t = 0.1, .normal_impulse = 2.0, .gap_rate_before = -2e-4});
  recorder.add(Event{0.3, EventKind::kLiftOff});
  recorder.add(Event{0.1, EventKind::kImpact});
  const Trajectory t = recorder.finish({0.5});
  ASSERT_EQ(t.impacts.size(), 2u);
  EXPECT_TRUE(counts(t.impacts[0]));
  EXPECT_FALSE(counts(t.impacts[1])) << "under 1e-4 m/s an impact is no impact in counts";
  ASSERT_EQ(t.events.size(), 2u);
  EXPECT_EQ(t.events[1].kind, EventKind::kLiftOff);
}

scene::Run make_run(double end, double spacing, std::vector<double> times = {}) {
  scene::Run run;
  run.end = end;
  run.output_step = spacing;
  run.output_times = std::move(times);
  return run;
}

// Multiples from zero, the end though it is no multiple, and what is asked for: exactly as given,
// in order, once. 3 * 0.1 is 0.30000000000000004: the same instant as 0.3.
TEST(OutputTimes, AreMultiplesTheEndAndTheTimesAskedFor) {
  const double next = std::nextafter(0.3, 1.0), third = 3 * 0.1;
  ASSERT_NE(third, 0.3);
  const struct {
    double end;
    std::vector<double> asked, expected;
  } cases[] = {
      {0.25, {}, {0.0, 0.1, 0.2, 0.25}},
      {0.05, {}, {0.0, 0.05}},
      {0.4, {0.1234, 0.2, 0.2, 0.0, 0.4, 0.35}, {0.0, 0.1, 0.1234, 0.2, third, 0.35, 0.4}},
      {0.5, {0.3}, {0.0, 0.1, 0.2, 0.3, 0.4, 0.5}},
      // Two requests give two rows, however close they are.
      {0.5, {0.3, next}, {0.0, 0.1, 0.2, 0.3, next, 0.4, 0.5}},
  };
  for (const auto& c : cases) EXPECT_EQ(output_times(make_run(c.end, 0.1, c.asked)), c.expected);
}

TEST(OutputTimes, AThousandRowsByDefault) {
  scene::Run run;
  run.end = 0.3;
  const std::vector<double> times = output_times(run);
  EXPECT_EQ(times.size(), 1001u);
  EXPECT_EQ(times.back(), 0.3) << "the end itself, whatever 1000 times a thousandth comes to";
}

TEST(OutputTimes, TheEndIsMetOnceForAnySpacing) {
  // If round-off puts the last multiple off the end, in either direction, it is the end.
  for (const double end : {0.1, 0.3, 0.7, 1.1, 2.3, 1.0 / 3.0}) {
    for (const int parts : {3, 7, 10, 30, 49, 1000}) {
      const std::vector<double> times = output_times(make_run(end, end / parts));
      ASSERT_EQ(times.size(), static_cast<std::size_t>(parts) + 1) << end << " / " << parts;
      EXPECT_EQ(times.back(), end);
    }
  }
}

}  // namespace
}  // namespace rotorub
