// The largest distance of an orbit: circles and ellipses, off the origin, of one and more
// frequencies.
#include "native_model/linear/free_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace rotorub {
namespace {

using Complex = std::complex<double>;
using Eigen::Vector2cd;

Vector2cd circle(double radius, double sense, double phase) {
  const Complex x = std::polar(radius, phase);
  return {x, Complex(0.0, -sense) * x};
}

TEST(OrbitSize, NothingMoves) {
  EXPECT_EQ(OrbitSize{}.largest(), 0.0);
  EXPECT_DOUBLE_EQ((OrbitSize{{3.0, 4.0}, {}}).largest(), 5.0);
  EXPECT_DOUBLE_EQ((OrbitSize{{3.0, 0.0}, {{0.0, {0.0, 4.0}}}}).largest(), 5.0)
      << "a constant part";
}

TEST(OrbitSize, CircleOffTheOrigin) {
  EXPECT_NEAR((OrbitSize{{0.3, -0.4}, {{7.0, circle(2.0, 1.0, 0.6)}}}).largest(), 2.5, 1e-9);
}

// Semi-axes a and b along x and y, middle at (c, 0): |d|^2 = (c + a cos)^2 + b^2 sin^2 is largest
// at cos = a c / (b^2 - a^2).
TEST(OrbitSize, EllipseOffTheOrigin) {
  const double a = 1.0, b = 2.0, c = 0.5;
  const double cosine = a * c / (b * b - a * a), sine = std::sqrt(1.0 - cosine * cosine);
  const double exact = std::hypot(c + a * cosine, b * sine);
  EXPECT_NEAR((OrbitSize{{c, 0.0}, {{3.0, {Complex(a), Complex(0.0, -b)}}}}).largest(), exact,
              1e-9);
}

// Of whole ratios the phases stay with one another: at phase pi the second circle is always against
// the first where it would add up. Of others every phase comes.
TEST(OrbitSize, PhasesThatMeetAndThatNeverMeet) {
  const auto size = [](double ratio, double phase) {
    return OrbitSize{{0.0, 0.0},
                     {{5.0, {Complex(1.0), Complex(0.0)}},
                      {5.0 * ratio, {std::polar(1.0, phase), Complex(0.0)}}}}
        .largest();
  };
  // cos t + cos 2 t has 2; cos t + sin 2 t its largest where -sin t + 2 cos 2 t = 0.
  EXPECT_NEAR(size(2.0, 0.0), 2.0, 1e-9);
  const double sine = (-1.0 - std::sqrt(33.0)) / 8.0, cosine = -std::sqrt(1.0 - sine * sine);
  const double other = (-1.0 + std::sqrt(33.0)) / 8.0, beside = std::sqrt(1.0 - other * other);
  const double exact =
      std::max(std::abs(cosine + 2.0 * sine * cosine), std::abs(beside + 2.0 * other * beside));
  EXPECT_NEAR(size(2.0, -0.5 * std::acos(-1.0)), exact, 1e-6);
  EXPECT_LT(exact, 1.8);
  EXPECT_NEAR(size(std::sqrt(2.0), -0.5 * std::acos(-1.0)), 2.0, 1e-9);
}

}  // namespace
}  // namespace rotorub
