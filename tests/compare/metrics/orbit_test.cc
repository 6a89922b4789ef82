// Spectra and sections of orbits whose whirls are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compare/metrics/orbit.h"
#include "tests/support/native_run.h"
#include "tests/support/orbit_run.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;
constexpr double kFullTurn = 2.0 * std::numbers::pi;
constexpr std::size_t kSamples = 1000;
constexpr double kSampling = 1e-3;  // s: a grid of 1 Hz, from -500 to 499 Hz

template <class Orbit>
std::vector<Complex> sampled(Orbit orbit, std::size_t count = kSamples) {
  std::vector<Complex> z;
  for (std::size_t n = 0; n < count; ++n) z.push_back(orbit(kSampling * static_cast<double>(n)));
  return z;
}

Complex circle(double radius, double frequency, double t) {
  return std::polar(radius, kFullTurn * frequency * t + 0.3);
}

double at(const FullSpectrum& s, double frequency) {
  return s.amplitude.at(static_cast<std::size_t>(std::lround(frequency)) + kSamples / 2);
}

TEST(FullSpectrum, TellsForwardFromBackwardWhirl) {
  const FullSpectrum s =
      full_spectrum(sampled([](double t) {
                      return Complex(5.0, -7.0) + circle(2.0, 50.0, t) + circle(0.5, -120.0, t);
                    }),
                    kSampling);
  ASSERT_EQ(s.frequency.size(), kSamples);
  EXPECT_EQ(s.frequency.front(), -500.0);
  EXPECT_EQ(s.frequency.back(), 499.0);
  EXPECT_NEAR(at(s, 50.0), 2.0, 1e-12);
  EXPECT_NEAR(at(s, -120.0), 0.5, 1e-12);
  EXPECT_NEAR(at(s, -50.0), 0.0, 1e-12);
  EXPECT_NEAR(at(s, 120.0), 0.0, 1e-12);
  EXPECT_NEAR(at(s, 0.0), 0.0, 1e-12) << "the mean is where it is, no whirl";
}

TEST(FullSpectrum, LosesLittleBetweenItsFrequencies) {
  const FullSpectrum s =
      full_spectrum(sampled([](double t) { return circle(1.0, 60.5, t); }), kSampling);
  EXPECT_GT(at(s, 60.0), 0.84);
  EXPECT_LT(at(s, 60.0), 0.86);
  EXPECT_NEAR(at(s, 60.0), at(s, 61.0), 1e-3);
  EXPECT_LT(at(s, 80.0), 1e-3) << "the window keeps it together";
}

// The plain mean of a part of a turn is not 0; without the window's weights it would show as a peak
// at 0 Hz.
TEST(FullSpectrum, HasNoPeakAtZeroWithoutWholeTurns) {
  for (const double frequency : {5.5, -7.3, 60.5}) {
    const FullSpectrum s =
        full_spectrum(sampled([=](double t) { return circle(1.0, frequency, t); }), kSampling);
    EXPECT_NEAR(at(s, 0.0), 0.0, 1e-12) << frequency;
    EXPECT_GT(at(s, frequency), 0.84) << frequency;
  }
}

TEST(FullSpectrum, TakesAnyLength) {
  for (const std::size_t count : {2U, 3U, 7U, 1001U}) {
    const FullSpectrum s =
        full_spectrum(sampled([](double t) { return circle(1.0, 9.0, t); }, count), kSampling);
    ASSERT_EQ(s.frequency.size(), count);
    ASSERT_EQ(s.amplitude.size(), count);
    for (const double a : s.amplitude) EXPECT_TRUE(std::isfinite(a));
    EXPECT_EQ(s.frequency[count / 2], 0.0);
  }
}

// A sweep at 100 Hz/s, backward: each stretch peaks where the sweep is in its middle.
TEST(Waterfall, FollowsASweep) {
  const Waterfall w =
      waterfall(sampled([](double t) { return std::polar(1.0, -kFullTurn * 50.0 * t * t); }, 4000),
                kSampling, 200);
  ASSERT_EQ(w.frequency.size(), 200U);
  ASSERT_EQ(w.time.size(), 77U);
  EXPECT_DOUBLE_EQ(w.time.front(), 0.1);
  for (std::size_t k = 0; k < w.time.size(); ++k) {
    const auto row = w.amplitude.begin() + static_cast<std::ptrdiff_t>(200 * k);
    const auto peak = std::max_element(row, row + 200) - row;
    EXPECT_NEAR(w.frequency[static_cast<std::size_t>(peak)], -100.0 * w.time[k], 5.1) << k;
  }
}

TEST(Waterfall, HasNoPeakAtZeroWithoutWholeTurns) {
  const Waterfall w =
      waterfall(sampled([](double t) { return circle(1.0, 12.3, t); }), kSampling, 200);
  for (std::size_t k = 0; k < w.time.size(); ++k)
    EXPECT_NEAR(w.amplitude[200 * k + 100], 0.0, 1e-12) << w.time[k];
}

// A fall is a parabola, also between rows 2.5 ms apart.
TEST(EvenOrbit, IsCubicBetweenRows) {
  const Trajectory run =
      test::run_event(test::shipped("bench_drop", {"run.end=0.01", "run.output_step=2.5e-3"}));
  ASSERT_EQ(run.rows(), 5U);
  const std::vector<Complex> z = even_orbit(run, 0.0, 0.01, 41);
  ASSERT_EQ(z.size(), 41U);
  for (std::size_t k = 0; k < z.size(); ++k) {
    const double t = 2.5e-4 * static_cast<double>(k);
    EXPECT_NEAR(z[k].imag(), -0.5 * 9.81 * t * t, 1e-12) << k;
    EXPECT_EQ(z[k].real(), 0.0);
  }
}

// A circle of radius 1 by `whirl` turns a turn of the spin, in the rows of a run of 1 s at `spin`
// Hz.
Trajectory circling(double spin, double whirl, std::size_t rows = 20001) {
  const std::complex<double> rate(0.0, kFullTurn * spin * whirl);
  return test::orbit_run(1.0, rows, [&](double t) {
    const double angle = kFullTurn * spin * t + 0.5;
    const auto place = std::polar(1.0, whirl * angle);
    return test::OrbitRow{place, rate * place, angle, kFullTurn * spin};
  });
}

TEST(Poincare, OfASynchronousMotionIsAPoint) {
  for (const double spin : {10.0, -10.0}) {
    const auto points = poincare_points(circling(spin, 1.0), 0.0);
    EXPECT_EQ(points.size(), 10U);
    for (const auto& p : points) {
      EXPECT_NEAR(p.real(), 1.0, 1e-12);
      EXPECT_NEAR(p.imag(), 0.0, 1e-12);
    }
  }
}

// Rows are for drawing: a circle with three rows a turn stays a circle.
TEST(Poincare, OfFewRowsATurnStaysOnTheCircle) {
  const auto points = poincare_points(circling(10.0, 0.9, 31), 0.0);
  EXPECT_EQ(points.size(), 10U);
  for (const auto& p : points) EXPECT_NEAR(std::abs(p), 1.0, 1e-12);
}

// Half the spin: two places in turn.
TEST(Poincare, OfHalfTheSpinIsTwoPoints) {
  const auto points = poincare_points(circling(10.0, 0.5), 0.0);
  ASSERT_EQ(points.size(), 10U);
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_NEAR(points[k].real(), k % 2 == 0 ? -1.0 : 1.0, 1e-12) << k;
  }
}

TEST(Poincare, BeginsWhereItIsAskedTo) {
  EXPECT_EQ(poincare_points(circling(10.0, 1.0), 0.5).size(), 5U);
  EXPECT_TRUE(poincare_points(circling(0.0, 1.0), 0.0).empty()) << "a rotor at rest has no turns";
}

TEST(SectionPeriod, CountsTheTurnsUntilPlacesComeBack) {
  std::vector<Complex> once(20, Complex(1.0, 2.0)), thrice, golden;
  for (int k = 0; k < 40; ++k) {
    thrice.push_back(circle(2.0, 1.0 / 3.0, k));
    golden.push_back(circle(2.0, 0.61803398875, k));
  }
  EXPECT_EQ(section_period(once, 1e-9), 1);
  EXPECT_EQ(section_period(thrice, 1e-9), 3);
  EXPECT_EQ(section_period(golden), 0) << "two frequencies never come back";
  EXPECT_EQ(section_period({thrice.begin(), thrice.begin() + 5}, 1e-9), 0) << "too few to tell";
  once.back() += 1e-3;
  EXPECT_EQ(section_period(once, 1e-9), 0);
}

}  // namespace
}  // namespace rotorub
