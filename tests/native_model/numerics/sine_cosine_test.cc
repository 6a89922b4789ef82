#include "native_model/numerics/sine_cosine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace rotorub {
namespace {

// Angles about the ends of quadrants, far from them and beyond the reduction.
std::vector<double> angles() {
  std::vector<double> out{0.0, -0.0, 1e-300, 1e-9, 9.99999e5, 1.000001e6, -3e7, 1e15};
  for (int k = -40; k <= 40; ++k) {
    const double at = 0.25 * std::numbers::pi * k;
    for (const double d : {0.0, 1e-15, -1e-15, 1e-8, -1e-8}) out.push_back(at + d);
  }
  std::mt19937_64 random(3);
  for (const double size : {1.0, 100.0, 1e4, 1e6, 1e8}) {
    std::uniform_real_distribution<double> value(-size, size);
    for (int i = 0; i < 20'000; ++i) out.push_back(value(random));
  }
  return out;
}

// Against long double of the same angle. Near a zero of one of the two its error is that of the
// reduction, in units of the other's.
TEST(SineCosine, AreThoseOfTheAngle) {
  constexpr double kUnit = std::numeric_limits<double>::epsilon();
  for (const double angle : angles()) {
    double s = 0.0, c = 0.0;
    sine_cosine(angle, s, c);
    ASSERT_NEAR(s, static_cast<double>(std::sin(static_cast<long double>(angle))), kUnit) << angle;
    ASSERT_NEAR(c, static_cast<double>(std::cos(static_cast<long double>(angle))), kUnit) << angle;
    ASSERT_NEAR(s * s + c * c, 1.0, 4.0 * kUnit) << angle;
  }
}

// A small angle keeps its digits.
TEST(SineCosine, OfSmallAngles) {
  for (const double angle : {1e-300, -1e-20, 1e-9, 1e-4}) {
    double s = 0.0, c = 0.0;
    sine_cosine(angle, s, c);
    EXPECT_DOUBLE_EQ(s, std::sin(angle));
    EXPECT_DOUBLE_EQ(c, std::cos(angle));
  }
}

}  // namespace
}  // namespace rotorub
