#include "compare/metrics/relative_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/compare/hand_made.h"

namespace rotorub {
namespace {

using test::hand_made;
using test::sliding;
using test::Whirl;

constexpr double kRoundOff = 1e-12;  // relative, a few operations

TEST(RelativeMotion, OfACircle) {
  const Whirl w;
  const auto points = relative_motion(hand_made(50, 1e-4, [&](double t) { return sliding(w, t); }));
  ASSERT_EQ(points.size(), 50U);
  for (const RelativePoint& p : points) {
    EXPECT_NEAR(p.delta, w.clearance, kRoundOff * w.clearance);
    EXPECT_NEAR(p.radial_rate, 0.0, kRoundOff);
    EXPECT_NEAR(p.whirl_speed, w.frequency * w.clearance, kRoundOff);
    EXPECT_NEAR(p.angle_rate, w.frequency, kRoundOff * w.frequency);
  }
}

TEST(RelativeMotion, CoincidingCentresHaveNoDirection) {
  const auto points = relative_motion(hand_made(1, 1.0, [](double) {
    test::Row row;
    row.vx = 1.0;
    return row;
  }));
  EXPECT_EQ(points[0].delta, 0.0);
  EXPECT_EQ(points[0].whirl_speed, 0.0);
  EXPECT_EQ(points[0].angle_rate, 0.0);
}

TEST(RelativeMotion, RowsBetweenTakesBothEnds) {
  const auto points = relative_motion(hand_made(11, 0.5, [](double) { return test::Row{}; }));
  const RowRange range = rows_between(points, 1.0, 2.0);
  EXPECT_EQ(range.first, 2U);
  EXPECT_EQ(range.last, 5U);
  EXPECT_EQ(rows_between(points, 7.0, 9.0).size(), 0U);
}

// The last bits of a time depend on how it was computed, and must not affect the result.
TEST(RelativeMotion, RowsBetweenTakesARowAtItsBeginningHoweverRounded) {
  auto points = relative_motion(hand_made(11, 0.5, [](double) { return test::Row{}; }));
  for (const double t : {std::nextafter(1.0, 0.0), 1.0, std::nextafter(1.0, 2.0)}) {
    points[2].t = t;
    EXPECT_EQ(rows_between(points, 1.0, 2.0).first, 2U);
    points[4].t = 1.0 + t;
    EXPECT_EQ(rows_between(points, 1.0, 2.0).last, 5U);
  }
}

TEST(WhirlFrequency, IsSigned) {
  for (const double frequency : {250.0, -250.0}) {
    Whirl w;
    w.frequency = frequency;
    const auto points =
        relative_motion(hand_made(200, 1e-4, [&](double t) { return sliding(w, t); }));
    EXPECT_NEAR(whirl_frequency(points, {0, 200}), frequency, 1e-9 * 250.0);
  }
}

// Rows are a turn and more apart: without the rates a fast backward whip would have any frequency.
TEST(WhirlFrequency, CountsTurnsBetweenFarRows) {
  Whirl w;
  w.frequency = -12566.0;
  const auto points =
      relative_motion(hand_made(100, 1.3e-3, [&](double t) { return sliding(w, t); }));
  EXPECT_NEAR(whirl_frequency(points, {0, 100}), w.frequency, 1e-6);
}

// A machine at rest: the perturbation of its twins by some ulps whirls at its natural frequency.
TEST(WhirlFrequency, OfAMachineAtRestIsZero) {
  Whirl w;
  w.clearance = 1e-19;
  const auto points =
      relative_motion(hand_made(200, 1e-4, [&](double t) { return sliding(w, t); }));
  EXPECT_EQ(whirl_frequency(points, {0, 200}), 0.0);
}

TEST(WhirlFrequency, NeedsTwoRows) {
  const auto points = relative_motion(hand_made(3, 1.0, [](double) { return test::Row{}; }));
  EXPECT_EQ(whirl_frequency(points, {1, 2}), 0.0);
  EXPECT_EQ(whirl_frequency(points, {1, 1}), 0.0);
}

// The ring moves too: d = r_rotor - r_ring, for positions and velocities.
TEST(RelativeMotion, IsSeenFromTheRing) {
  Trajectory t = test::hand_made(1, 1.0, [](double) {
    test::Row row;
    row.x = 7.0, row.y = 1.0, row.vx = 0.5, row.vy = 3.0;
    return row;
  });
  const auto ring = [&](const char* name, double value) {
    for (Column& column : t.series) {
      if (column.name == name) column.values[0] = value;
    }
  };
  ring("stator_x", 4.0), ring("stator_y", -3.0), ring("stator_vx", -0.5), ring("stator_vy", 1.0);
  const RelativePoint p = relative_motion(t).front();  // d = (3, 4), its rate (1, 2)
  EXPECT_DOUBLE_EQ(p.delta, 5.0);
  EXPECT_DOUBLE_EQ(p.angle, std::atan2(4.0, 3.0));
  EXPECT_DOUBLE_EQ(p.radial_rate, (3.0 * 1.0 + 4.0 * 2.0) / 5.0);
  EXPECT_DOUBLE_EQ(p.whirl_speed, (3.0 * 2.0 - 4.0 * 1.0) / 5.0);
}

}  // namespace
}  // namespace rotorub
