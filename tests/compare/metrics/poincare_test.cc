// Places once a turn, of motions whose sections are known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "compare/metrics/orbit.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// A circle of radius 1 by `whirl` turns a turn of the spin, in the rows of a run of 1 s at `spin`
// Hz.
Trajectory circling(double spin, double whirl, std::size_t rows = 20001) {
  Trajectory t;
  std::vector<double> time, angle, x, y;
  for (std::size_t i = 0; i < rows; ++i) {
    time.push_back(static_cast<double>(i) / static_cast<double>(rows - 1));
    angle.push_back(kTurn * spin * time.back() + 0.5);
    x.push_back(std::cos(whirl * angle.back()));
    y.push_back(std::sin(whirl * angle.back()));
  }
  t.series = {
      {"t", "s", time}, {"rotor_x", "m", x}, {"rotor_y", "m", y}, {"spin_angle", "rad", angle}};
  return t;
}

TEST(Poincare, OfASynchronousMotionIsAPoint) {
  for (const double spin : {10.0, -10.0}) {
    const auto points = poincare_points(circling(spin, 1.0), 0.0);
    EXPECT_EQ(points.size(), 10U);
    for (const auto& p : points) {
      EXPECT_NEAR(p.real(), 1.0, 1e-5);
      EXPECT_NEAR(p.imag(), 0.0, 1e-5);
    }
  }
}

// Half the spin: two places in turn.
TEST(Poincare, OfHalfTheSpinIsTwoPoints) {
  const auto points = poincare_points(circling(10.0, 0.5), 0.0);
  ASSERT_EQ(points.size(), 10U);
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_NEAR(points[k].real(), k % 2 == 0 ? -1.0 : 1.0, 1e-5) << k;
  }
}

TEST(Poincare, BeginsWhereItIsAskedTo) {
  EXPECT_EQ(poincare_points(circling(10.0, 1.0), 0.5).size(), 5U);
  EXPECT_TRUE(poincare_points(circling(0.0, 1.0), 0.0).empty()) << "a rotor at rest has no turns";
}

}  // namespace
}  // namespace rotorub
