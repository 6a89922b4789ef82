#include <gtest/gtest.h>

#include <cmath>

#include "compare/metrics/divergence.h"
#include "tests/compare/hand_made.h"

namespace rotorub {
namespace {

using test::at_two_contacts;
using test::hand_made;
using test::Row;

// A rotor that moves away from the origin along x at the given speed.
Trajectory moving(double speed, std::size_t rows = 101, double spacing = 0.01) {
  return hand_made(rows, spacing, [&](double t) {
    Row row;
    row.x = speed * t;
    return row;
  });
}

TEST(Divergence, FindsTheFirstRowBeyondTheThreshold) {
  const Divergence d = divergence(moving(1.0), moving(1.5), 0.1049);
  ASSERT_TRUE(d.time);
  EXPECT_NEAR(*d.time, 0.21, 1e-12);
  EXPECT_NEAR(d.max_distance, 0.5, 1e-12);
  EXPECT_EQ(d.rows, 101U);
  // 0.5 k / 100 at row k: sum of k^2 to n is n (n + 1) (2 n + 1) / 6.
  EXPECT_NEAR(d.rms_distance, 0.5 / 100.0 * std::sqrt(100.0 * 101.0 * 201.0 / 6.0 / 101.0), 1e-12);
}

// The distance along y counts as along x.
TEST(Divergence, IsADistanceInThePlane) {
  const auto at = [](double x, double y) {
    return hand_made(2, 0.1, [=](double) {
      Row row;
      row.x = x, row.y = y;
      return row;
    });
  };
  EXPECT_NEAR(divergence(at(0.1, 0.2), at(0.4, 0.6), 1.0).max_distance, 0.5, 1e-15);
}

TEST(Divergence, EqualRunsNeverPart) {
  const Divergence d = divergence(moving(1.0), moving(1.0), 1e-12);
  EXPECT_FALSE(d.time);
  EXPECT_EQ(d.max_distance, 0.0);
  EXPECT_EQ(d.rms_distance, 0.0);
}

// Only rows at the same time are compared: one run is twice as dense and longer.
TEST(Divergence, ComparesEqualTimesAlone) {
  const Divergence d = divergence(moving(1.0, 11, 0.5), moving(1.0, 41, 0.25), 1e-12);
  EXPECT_EQ(d.rows, 11U);
  EXPECT_FALSE(d.time);
}

// At one contact the runs part by 0.5 m/s, at the other by 0.1 m/s.
TEST(Divergence, IsTheLargestAtAnyContactInAnyOrder) {
  const Trajectory fast_a = moving(1.0), fast_b = moving(1.5), slow_a = moving(2.0),
                   slow_b = moving(2.1);
  const Divergence one = divergence(at_two_contacts(fast_a, slow_a),
                                    at_two_contacts(fast_b, slow_b), 0.1049),
                   other = divergence(at_two_contacts(slow_a, fast_a),
                                      at_two_contacts(slow_b, fast_b), 0.1049);
  for (const Divergence& d : {one, other}) {
    ASSERT_TRUE(d.time);
    EXPECT_NEAR(*d.time, 0.21, 1e-12);
    EXPECT_NEAR(d.max_distance, 0.5, 1e-12);
  }
  EXPECT_EQ(one.rms_distance, other.rms_distance);
}

Impact closing_at(double t) {
  Impact impact;
  impact.t = t;
  impact.normal_impulse = t;
  impact.gap_rate_before = -0.1;
  return impact;
}

TEST(Impacts, ArePairedByOrder) {
  Trajectory a, b;
  for (const double t : {0.1, 0.2, 0.3}) a.impacts.push_back(closing_at(t));
  for (const double t : {0.11, 0.22}) b.impacts.push_back(closing_at(t));
  // A touch that does not count is not compared.
  a.impacts.insert(a.impacts.begin() + 1, Impact{});

  const auto pairs = pair_impacts(a, b, 5);
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_EQ(pairs[0].a->t, 0.1);
  EXPECT_EQ(pairs[0].b->t, 0.11);
  EXPECT_EQ(pairs[1].a->t, 0.2);
  EXPECT_EQ(pairs[1].b->t, 0.22);
  EXPECT_EQ(pairs[2].a->t, 0.3);
  EXPECT_FALSE(pairs[2].b);
  EXPECT_EQ(pair_impacts(a, b, 1).size(), 1U);
}

}  // namespace
}  // namespace rotorub
