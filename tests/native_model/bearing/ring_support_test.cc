// The laws of the ring's support, each against a sum, an integral or a closed form.
#include "native_model/bearing/ring_support.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

namespace rotorub {
namespace {

using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

const scene::SqueezeFilm kFilm{0.04, 0.02, 0.1e-3, 0.03, true};
scene::SqueezeFilm full() {
  scene::SqueezeFilm film = kFilm;
  film.cavitation = false;
  return film;
}
// N s/m, mu R L^3 / c^3.
constexpr double kScale = 0.03 * 0.04 * 8e-6 / 1e-12;

// By the midpoint rule, of a periodic integrand without cavitation; where the film ends the
// integrand is 0, so that the rule errs by its step squared.
Vector2d summed(const scene::SqueezeFilm& film, const Vector2d& r, const Vector2d& w) {
  constexpr int kSteps = 200000;
  Vector2d sum{0.0, 0.0};
  for (int i = 0; i < kSteps; ++i) {
    const double a = 2.0 * kPi * (i + 0.5) / kSteps;
    const Vector2d n(std::cos(a), std::sin(a));
    const double closing = w.dot(n), h = film.clearance - r.dot(n);
    if (film.cavitation && closing <= 0.0) continue;
    sum -= closing / (h * h * h) * n;
  }
  return film.viscosity * film.radius * std::pow(film.length, 3) * 2.0 * kPi / kSteps * sum;
}

TEST(SqueezeFilm, IsTheIntegralOfItsPressure) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 12; ++k) {
    const Vector2d r = 0.65e-4 * Vector2d(unit(random), unit(random));
    const Vector2d w = 0.1 * Vector2d(unit(random), unit(random));
    for (const scene::SqueezeFilm& film : {kFilm, full()}) {
      const Vector2d exact = summed(film, r, w);
      EXPECT_LT((SqueezeFilmLaw(film).force(r, w) - exact).norm(), 1e-8 * exact.norm()) << k;
    }
  }
}

// Circular orbits of the short bearing (Vance 1988): over mu R L^3 e omega / c^3 tangentially
// pi / (1 - E^2)^(3/2) without cavitation and half of it with, and then radially
// 2 E / (1 - E^2)^2, inwards.
TEST(SqueezeFilm, CircularOrbits) {
  constexpr double kOmega = 300.0;
  for (const double e : {0.0, 1e-6, 0.2, 0.5, 0.9, 0.98}) {
    const Vector2d r(e * kFilm.clearance, 0.0), w(0.0, kOmega * r.x());
    const double size = kScale * r.x() * kOmega, root = std::sqrt(1.0 - e * e);
    const Vector2d whole = SqueezeFilmLaw(full()).force(r, w);
    EXPECT_NEAR(whole.y(), -kPi / std::pow(root, 3) * size, 1e-12 * size / std::pow(root, 3));
    EXPECT_NEAR(whole.x(), 0.0, 1e-12 * size / std::pow(root, 5));
    const Vector2d half = SqueezeFilmLaw(kFilm).force(r, w);
    EXPECT_NEAR(half.y(), -0.5 * kPi / std::pow(root, 3) * size, 1e-12 * size / std::pow(root, 3));
    EXPECT_NEAR(half.x(), -2.0 * e / std::pow(root, 4) * size, 1e-12 * size / std::pow(root, 4));
  }
}

// The damper of ROSS's tests (github.com/petrobras/ross): 5.1 x 0.9 in, 3 mil of clearance, an
// orbit of half of it at 18,600 rpm; damping and stiffness as force over size and over speed of the
// orbit.
TEST(SqueezeFilm, DamperOfRoss) {
  constexpr double kInch = 0.0254, kOmega = 18600.0 * kPi / 30.0;
  scene::SqueezeFilm film{2.55 * kInch, 0.9 * kInch, 0.003 * kInch, 0.0279679, true};
  const Vector2d r(0.5 * film.clearance, 0.0), w(0.0, kOmega * r.x());
  const Vector2d half = SqueezeFilmLaw(film).force(r, w);
  EXPECT_NEAR(-half.y() / w.y(), 118284.0, 0.5);
  EXPECT_NEAR(-half.x() / r.x(), 1.6936e8, 0.00005e8);
  film.cavitation = false;
  const Vector2d whole = SqueezeFilmLaw(film).force(r, w);
  EXPECT_NEAR(-whole.y() / w.y(), 236568.0, 0.5);
  EXPECT_NEAR(whole.x() / r.x(), 0.0, 1.0);
}

// ---------------------------------------------------------------- balls
constexpr scene::BallSupport kBalls{9, 5e9, 10e-6, 0.3};

TEST(BallBearing, OneBallBearsByHertzsLaw) {
  const BallBearingLaw law(kBalls);
  const Vector2d n(std::cos(0.3), std::sin(0.3));
  EXPECT_EQ(law.force(10e-6 * n).norm(), 0.0);
  // The neighbours, at 40 degrees, bear from 10 um / cos 40 degrees on.
  const double pressed = 2e-6;
  EXPECT_LT((law.force((10e-6 + pressed) * n) + 5e9 * std::pow(pressed, 1.5) * n).norm(), 1e-9);
}

// Stribeck 1907: with many balls and no play the load is balls / 4.37 times that on the most loaded
// one: 1 over the mean of cos^(5/2), cut off below 0, over the turn.
TEST(BallBearing, StribecksNumber) {
  const double exact = 2.0 * std::sqrt(kPi) * std::tgamma(2.25) / std::tgamma(1.75);
  EXPECT_NEAR(exact, 4.37, 5e-3);
  for (const int balls : {30, 60, 100}) {
    const BallBearingLaw law({balls, 5e9, 0.0, 0.0});
    const double most = 5e9 * std::pow(20e-6, 1.5);
    EXPECT_NEAR(balls * most / -law.force({20e-6, 0.0}).x(), exact, 1e-3) << balls;
  }
}

TEST(BallBearing, IsASpringWithAnEnergyAndABoundedSlope) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const BallBearingLaw law(kBalls);
  for (int k = 0; k < 500; ++k) {
    const Vector2d r = 40e-6 * Vector2d(unit(random), unit(random));
    Eigen::Matrix2d slope;
    for (int i = 0; i < 2; ++i) {
      const Vector2d h = 1e-10 * Vector2d::Unit(i);
      slope.col(i) = -(law.force(r + h) - law.force(r - h)) / 2e-10;
    }
    EXPECT_NEAR(slope(0, 1), slope(1, 0), 1e-6 * (slope.norm() + 1e7));
    EXPECT_LE(slope.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff(),
              law.stiffness(r.norm()) * (1.0 + 1e-6) + 1e5);
    const Eigen::Rotation2Dd ball(2.0 * kPi / 9.0);
    EXPECT_LT((law.force(ball * r) - ball * law.force(r)).norm(),
              1e-9 * (1.0 + law.force(r).norm()));
  }
}

// ---------------------------------------------------------------- dry friction
// Along a straight path the state is 1 - exp(-x / d), and after a reversal 2 exp(-x / d) - 1.
TEST(DryFriction, FollowsTheWay) {
  constexpr double kWay = 1e-5;
  double s = 0.0;
  const auto go = [&](double velocity, double length) {
    constexpr int kSteps = 4000;
    const double h = length / std::abs(velocity) / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      const double middle = s + 0.5 * h * bristle_rate(velocity, s, kWay);
      s += h * bristle_rate(velocity, middle, kWay);
    }
  };
  go(0.3, 2.0 * kWay);
  EXPECT_NEAR(s, 1.0 - std::exp(-2.0), 1e-6);
  go(0.3, 40.0 * kWay);
  EXPECT_NEAR(s, 1.0, 1e-12);
  go(-0.01, kWay);
  EXPECT_NEAR(s, 2.0 * std::exp(-1.0) - 1.0, 1e-6);
}

// On a circle of radius X the state lags the velocity: with z = x + i y, s = i X / (d i + X) e^{i
// a}.
TEST(DryFriction, CircularOrbit) {
  constexpr double kWay = 1e-5, kOmega = 200.0;
  for (const double radius : {0.2e-5, 1e-5, 20e-5}) {
    const std::complex<double> i(0.0, 1.0);
    Vector2d s(0.0, 0.0);
    constexpr double kStep = 2e-6;
    double t = 0.0;
    const auto rate = [&](double at, const Vector2d& state) {
      const double a = kOmega * at;
      return bristle_rate(radius * kOmega * Vector2d(-std::sin(a), std::cos(a)), state, kWay);
    };
    for (; t < 0.5; t += kStep) {
      const Vector2d middle = s + 0.5 * kStep * rate(t, s);
      s += kStep * rate(t + 0.5 * kStep, middle);
    }
    const std::complex<double> exact = i * radius / (i * kWay + radius) * std::exp(i * kOmega * t);
    EXPECT_NEAR(s.x(), exact.real(), 1e-6) << radius;
    EXPECT_NEAR(s.y(), exact.imag(), 1e-6) << radius;
  }
}

}  // namespace
}  // namespace rotorub
