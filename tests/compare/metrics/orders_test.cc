// 1x and 2x of runs whose whirl is known.
#include "compare/metrics/orders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/support/orbit_run.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;
constexpr double kWholeTurn = 2.0 * std::numbers::pi;

// From `from` to `to` Hz in 1 s: z = sum_k r_k e^{i k phi}, k = 1, -1, 2, 3, and a constant.
Trajectory run_up(double from, double to, std::size_t rows, double offset = 0.4) {
  const Complex r1 = std::polar(20e-6, 0.5), back = std::polar(6e-6, -1.0),
                r2 = std::polar(3e-6, 2.0), r3 = 2e-6, still(5e-6, -9e-6);
  return test::orbit_run(1.0, rows, [&](double t) {
    const double phi = offset + kWholeTurn * (from * t + 0.5 * (to - from) * t * t),
                 omega = kWholeTurn * (from + (to - from) * t);
    const auto turn = [&](double k) { return std::polar(1.0, k * phi); };
    const Complex z = still + r1 * turn(1) + back * turn(-1) + r2 * turn(2) + r3 * turn(3);
    const Complex v = Complex(0.0, omega) *
                      (r1 * turn(1) - back * turn(-1) + 2.0 * r2 * turn(2) + 3.0 * r3 * turn(3));
    return test::OrbitRow{z, v, phi, omega};
  });
}

TEST(OrderTrack, HasTheVectorsOfARunUp) {
  const OrderTrack track = order_track(run_up(20.0, 80.0, 4001), 1000);
  ASSERT_EQ(track.t.size(), 185u) << "50 turns, 4 in a stretch, a quarter between two";
  const Complex once = std::polar(20e-6, 0.5) + std::conj(std::polar(6e-6, -1.0)),
                twice = std::polar(3e-6, 2.0);
  for (std::size_t k = 0; k < track.t.size(); ++k) {
    EXPECT_NEAR(track.speed[k] / kWholeTurn, 20.0 + 60.0 * track.t[k], 1e-3);
    EXPECT_LT(std::abs(track.probe[k][0] - once), 2e-4 * std::abs(once)) << k;
    EXPECT_LT(std::abs(track.probe[k][1] - twice), 2e-4 * std::abs(once)) << k;
  }
  EXPECT_EQ(order_track(run_up(20.0, 80.0, 4001), 10).t.size(), 10u);
}

// With the mark of a rotor that turns the other way the motion is mirrored.
TEST(OrderTrack, FollowsASpinOfEitherSense) {
  Trajectory mirrored = run_up(20.0, 80.0, 4001);
  for (Column& c : mirrored.series) {
    if (c.name == "t" || c.name == "rotor_x" || c.name == "rotor_vx") continue;
    for (double& value : c.values) value = -value;
  }
  const OrderTrack track = order_track(run_up(20.0, 80.0, 4001), 50),
                   other = order_track(mirrored, 50);
  ASSERT_EQ(track.t.size(), other.t.size());
  for (std::size_t k = 0; k < track.t.size(); ++k) {
    EXPECT_LT(std::abs(track.probe[k][0] - other.probe[k][0]), 1e-12) << k;
    EXPECT_NEAR(track.speed[k], -other.speed[k], 1e-9);
  }
}

// Dense and requested rows that are equal but for round-off, and jumps.
TEST(OrderTrack, TakesRowsThatAreOneInstant) {
  const Trajectory run = run_up(20.0, 80.0, 4001);
  Trajectory twice = run;
  for (Column& c : twice.series) {
    for (const std::size_t row : {3000u, 2000u, 1000u}) {
      const auto at = c.values.begin() + row;
      c.values.insert(at, c.name == "t" && row == 2000u ? std::nextafter(*at, 0.0) : *at);
    }
  }
  const OrderTrack one = order_track(run, 50), other = order_track(twice, 50);
  ASSERT_EQ(one.t.size(), other.t.size());
  for (std::size_t k = 0; k < one.t.size(); ++k)
    EXPECT_LT(std::abs(one.probe[k][0] - other.probe[k][0]), 1e-12);
}

TEST(OrderTrack, IsNothingWhereOrdersCannotBeTold) {
  EXPECT_TRUE(order_track(run_up(20.0, 80.0, 201), 50).t.empty()) << "4 rows a turn";
  EXPECT_TRUE(order_track(run_up(1.0, 2.0, 4001), 50).t.empty()) << "a turn and a half";
  EXPECT_TRUE(order_track(run_up(-40.0, 80.0, 4001), 50).t.empty()) << "it turns back";
  EXPECT_FALSE(order_track(run_up(0.0, 80.0, 4001), 50).t.empty()) << "from rest";
}

}  // namespace
}  // namespace rotorub
