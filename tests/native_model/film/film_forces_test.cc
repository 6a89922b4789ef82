#include "native_model/film/film_forces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

namespace rotorub {
namespace {

double sommerfeld(const FilmForces& f) { return 1.0 / (std::numbers::pi * std::hypot(f.r, f.t)); }
double attitude(const FilmForces& f) { return std::atan2(f.t, -f.r) * 180.0 / std::numbers::pi; }

// Sommerfeld's number mu N L D / W (R / c)^2 and the attitude in degrees of A. A. Raimondi, J.
// Boyd, "A solution for the finite journal bearing and its application to analysis and design",
// ASLE Transactions 1, 1958, from finite differences: to their three digits, but for a few of its
// points.
TEST(FiniteFilm, RaimondiAndBoyd) {
  const std::vector<std::tuple<double, double, double, double>> published{
      {1.0, 0.1, 1.33, 79.5},    {1.0, 0.2, 0.631, 74.02},  {1.0, 0.6, 0.121, 50.58},
      {1.0, 0.8, 0.0446, 36.24}, {1.0, 0.9, 0.0188, 26.45}, {1.0, 0.97, 0.00474, 15.47},
      {0.5, 0.1, 4.31, 81.62},   {0.5, 0.2, 2.03, 74.94},   {0.5, 0.4, 0.779, 61.45},
      {0.5, 0.6, 0.319, 48.14},  {0.5, 0.8, 0.0923, 33.31}, {0.5, 0.9, 0.0313, 23.66},
      {0.25, 0.1, 16.2, 82.31},  {0.25, 0.2, 7.57, 75.18},  {0.25, 0.4, 2.83, 60.86},
      {0.25, 0.6, 1.07, 46.72},  {0.25, 0.8, 0.261, 31.04}, {0.25, 0.9, 0.0736, 21.85}};
  for (const auto& [ratio, e, S, angle] : published) {
    const FilmForces f = finite_film(ratio, e);
    EXPECT_NEAR(sommerfeld(f) / S, 1.0, 0.011) << ratio << " " << e;
    EXPECT_NEAR(attitude(f), angle, 0.4) << ratio << " " << e;
  }
}

// Short: the forces differ from Ocvirk's by the square of the length. The squeeze film's pressure
// vanishes at both ends of the half, in layers as wide as the film is long.
TEST(FiniteFilm, TendsToTheShortFilm) {
  for (const double e : {0.2, 0.5, 0.8}) {
    const FilmForces finite = finite_film(0.02, e), exact = short_film(0.02, e);
    for (const double FilmForces::*part : {&FilmForces::r, &FilmForces::t}) {
      EXPECT_NEAR(finite.*part / (exact.*part), 1.0, 2e-3) << e;
    }
    for (const double FilmForces::*part : {&FilmForces::slope_r, &FilmForces::slope_t}) {
      EXPECT_NEAR(finite.*part / (exact.*part), 1.0, 3e-3) << e;
    }
    for (const double FilmForces::*part : {&FilmForces::damping_r, &FilmForces::damping_t}) {
      EXPECT_NEAR(finite.*part / (exact.*part), 1.0, 1e-2) << e;
    }
  }
}

// Long, under Reynolds' condition: the film ends at g in Sommerfeld's variable, where
// e (sin g cos g - g) + 2 (sin g - g cos g) = 0, and
//   r = -3 e (1 - cos g)^2 / ((1 - e^2) (1 - e cos g)),
//   t = 6 (sin g - g cos g) / (sqrt(1 - e^2) (1 - e cos g)).
// Towards its ends, in layers of about the diameter, the pressure falls to 0.
TEST(FiniteFilm, TendsToTheLongFilm) {
  constexpr double kRatio = 200.0;
  for (const double e : {0.1, 0.4, 0.6, 0.8, 0.9}) {
    double from = std::numbers::pi, to = 2.0 * std::numbers::pi;
    for (int step = 0; step < 60; ++step) {
      const double g = 0.5 * (from + to), s = std::sin(g), c = std::cos(g);
      (e * (s * c - g) + 2.0 * (s - g * c) > 0.0 ? from : to) = g;
    }
    const double c = std::cos(from), rest = 1.0 - e * e;
    const FilmForces f = finite_film(kRatio, e);
    const double r = -3.0 * e * (1.0 - c) * (1.0 - c) / (rest * (1.0 - e * c));
    const double t = 6.0 * (std::sin(from) - from * c) / (std::sqrt(rest) * (1.0 - e * c));
    EXPECT_NEAR(f.r / r, 0.9855, 2e-3) << e;
    EXPECT_NEAR(f.t / t, 0.9855, 2e-3) << e;
  }
}

TEST(Films, SlopesAreTheDerivatives) {
  for (const auto& film : {short_film, finite_film}) {
    for (const double ratio : {0.3, 1.0, 5.0}) {
      for (const double e : {0.05, 0.3, 0.6, 0.9}) {
        const double d = 1e-3 * (1.0 - e);
        const FilmForces f = film(ratio, e), low = film(ratio, e - d), high = film(ratio, e + d);
        EXPECT_NEAR((high.r - low.r) / (2.0 * d * f.slope_r), 1.0, 2e-3) << ratio << " " << e;
        EXPECT_NEAR((high.t - low.t) / (2.0 * d * f.slope_t), 1.0, 2e-3) << ratio << " " << e;
      }
    }
  }
}

// The damping matrix is symmetric, because the operator is.
TEST(Films, DampingIsSymmetric) {
  for (const auto& film : {short_film, finite_film}) {
    for (const double ratio : {0.1, 1.0, 3.0}) {
      for (const double e : {0.05, 0.5, 0.97}) {
        const FilmForces f = film(ratio, e);
        EXPECT_NEAR(f.damping_t * e / (-2.0 * f.r), 1.0, 1e-12) << ratio << " " << e;
        EXPECT_LT(f.damping_r, 0.0);
      }
    }
  }
}

}  // namespace
}  // namespace rotorub
