#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "native_model/bearing/actuator.h"

namespace rotorub {
namespace {

const Electromagnet::Parameters kMagnet{4e-4, 3.0, 5e-3, 2e4};
constexpr double kLimit = 2.5;  // A

TEST(Electromagnet, ForceByHand) {
  const Electromagnet law(kMagnet);
  EXPECT_EQ(law.force(0.0, 0.0), 0.0);
  // i = 1 A in the middle: k_m (16 - 4) / s_0^2.
  EXPECT_NEAR(law.force(0.0, 1.0), 192.0, 1e-12);
  // s = 1 mm without control current: 9 k_m (1/16 - 1/36) 1e6 - c s = 125 - 20 N.
  EXPECT_NEAR(law.force(1e-3, 0.0), 105.0, 1e-12);
  EXPECT_NEAR(law.force(-1e-3, 0.0), -105.0, 1e-12);
  // Both: k_m (16/16 - 4/36) 1e6 - 20 N.
  EXPECT_NEAR(law.force(1e-3, 1.0), 4e-4 * 1e6 * (1.0 - 1.0 / 9.0) - 20.0, 1e-12);
}

TEST(Electromagnet, GainAndBiasMakeTheForce) {
  const Electromagnet law(kMagnet);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 2000; ++k) {
    const double s = 4.9e-3 * unit(random), i = 3.0 * unit(random);
    const double force = law.force(s, i);
    EXPECT_NEAR(law.gain(s, i) * i + law.force(s, 0.0), force, 1e-12 * (1e3 + std::abs(force)));
  }
}

TEST(Electromagnet, CurrentIsTheInverse) {
  const Electromagnet law(kMagnet);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 2000; ++k) {
    const double s = 4.9e-3 * unit(random), i = kLimit * unit(random);
    EXPECT_NEAR(law.current(s, law.force(s, i), kLimit), i, 1e-12) << s;
  }
}

// Also if the quadratic has no root, near a core and far beyond the force of the magnets.
TEST(Electromagnet, OutOfReachIsTheLimit) {
  const Electromagnet law(kMagnet);
  for (const double s : {-4.9e-3, -1e-3, 0.0, 1e-3, 4.9e-3}) {
    const double most = law.force(s, kLimit), least = law.force(s, -kLimit);
    for (const double beyond : {1.0, 1e3, 1e9}) {
      EXPECT_EQ(law.current(s, most + beyond, kLimit), kLimit) << s;
      EXPECT_EQ(law.current(s, least - beyond, kLimit), -kLimit) << s;
    }
  }
}

// The formula has a pole at s = s_0, which a ring that escapes passes.
TEST(Electromagnet, FiniteAtAndBeyondTheCores) {
  const Electromagnet law(kMagnet);
  for (const double s : {5e-3, -5e-3, 0.1, -1e6}) {
    EXPECT_TRUE(std::isfinite(law.force(s, 1.0))) << s;
    EXPECT_TRUE(std::isfinite(law.gain(s, 1.0))) << s;
    EXPECT_LE(std::abs(law.current(s, 10.0, kLimit)), kLimit) << s;
  }
}

const Electromagnet kSmoothMagnet({4e-4, 3.0, 5e-3, 0.0});
constexpr double kReach = 2e-3, kCurrent = 2.5;  // m, A

// n x n values of a function over +-reach and +-current, unevenly spaced.
template <typename Function>
ForceGrid grid(int n, Function f) {
  ForceGrid g;
  for (int k = 0; k < n; ++k) {
    const double x = -1.0 + 2.0 * k / (n - 1), uneven = x + 0.1 * x * (1.0 - x * x);
    g.position.push_back(kReach * uneven);
    g.current.push_back(kCurrent * uneven);
  }
  for (const double s : g.position) {
    for (const double i : g.current) g.force.push_back(f(s, i));
  }
  return g;
}

double of_magnet(double s, double i) { return kSmoothMagnet.force(s, i); }

// Cubic in both: the spline is the function itself.
double cubic(double s, double i) {
  const double x = s / kReach, y = i / kCurrent;
  return (5.0 + x - 2.0 * x * x * x) + (30.0 + 4.0 * x * x) * y + (3.0 + x) * y * y * y;
}

double largest_error(const ForceTable& table, double (*f)(double, double)) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  double most = 0.0;
  for (int k = 0; k < 5000; ++k) {
    const double s = kReach * unit(random), i = kCurrent * unit(random);
    most = std::max(most, std::abs(table.force(s, i) - f(s, i)));
  }
  return most;
}

TEST(ForceTable, IsExactForCubics) {
  EXPECT_LT(largest_error(ForceTable(grid(4, cubic)), cubic), 1e-11);
  EXPECT_LT(largest_error(ForceTable(grid(9, cubic)), cubic), 1e-11);
}

TEST(ForceTable, ConvergesWithTheFourthPower) {
  const double coarse = largest_error(ForceTable(grid(10, of_magnet)), of_magnet);
  const double fine = largest_error(ForceTable(grid(20, of_magnet)), of_magnet);
  EXPECT_LT(coarse, 5.0) << "of 1000 N";
  EXPECT_GT(coarse / fine, 10.0);
}

TEST(ForceTable, CurrentIsTheInverse) {
  const ForceTable table(grid(12, of_magnet));
  ASSERT_EQ(table.refusal(), "");
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 2000; ++k) {
    const double s = kReach * unit(random), i = 2.0 * unit(random);
    EXPECT_NEAR(table.current(s, table.force(s, i), 2.0), i, 1e-12) << s;
  }
  for (const double s : {-kReach, 0.0, kReach}) {
    EXPECT_EQ(table.current(s, 1e6, 2.0), 2.0);
    EXPECT_EQ(table.current(s, -1e6, 2.0), -2.0);
  }
}

TEST(ForceTable, GainAndBiasMakeTheForce) {
  const ForceTable table(grid(12, of_magnet));
  for (const double i : {-2.0, -1e-3, -1e-9, 0.0, 1e-9, 0.5, 2.5}) {
    EXPECT_NEAR(table.gain(7e-4, i) * i + table.force(7e-4, 0.0), table.force(7e-4, i), 1e-9) << i;
  }
  EXPECT_NEAR(table.gain(0.0, 0.0), kSmoothMagnet.gain(0.0, 0.0), 1.0);
}

TEST(ForceTable, BeyondItsEdgesTheForceIsHeld) {
  const ForceTable table(grid(6, of_magnet));
  EXPECT_EQ(table.force(1.0, 1.0), table.force(kReach, 1.0));
  EXPECT_EQ(table.force(1e-4, -9.0), table.force(1e-4, -kCurrent));
}

// The values rise everywhere, but the spline between them does not.
TEST(ForceTable, SaysWhereItHasNoInverse) {
  const auto step = [](double, double i) { return i + (i > 0.1 ? 500.0 : 0.0); };
  const std::string reason = ForceTable(grid(8, step)).refusal();
  EXPECT_NE(reason.find("does not rise"), std::string::npos) << reason;
}

}  // namespace
}  // namespace rotorub
