// The annular rub, put into the complex equations of motion that it solves.
#include "native_model/oracles/annular_rub.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/oracles/elastic_whip.h"
#include "tests/support/runge_kutta.h"

namespace rotorub::oracle {
namespace {

using Complex = std::complex<double>;
constexpr double kResidual = 1e-12;  // of the largest term

struct Case {
  Support rotor, ring;
  double clearance, mu, load, frequency;
};

// Excitation around resonance, with loads from too small to large.
Case random_case(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Case c;
  c.rotor = {1.0 + unit(random), 100.0 * unit(random), 2e5 * (0.5 + unit(random))};
  c.ring = {0.5 + unit(random), 400.0 * unit(random), 3e5 * unit(random)};
  c.clearance = 0.5e-3 * (0.2 + unit(random));
  c.mu = unit(random);
  c.load = 400.0 * unit(random);
  c.frequency = 600.0 * unit(random) - 100.0;
  return c;
}

// z'' and z' of z e^{i w t} at t = 0.
Complex motion(const Support& s, const Complex& z, double w) {
  return s.mass * -(w * w) * z + s.damping * Complex(0.0, w) * z + s.stiffness * z;
}

TEST(AnnularRub, OnARigidRingSolvesTheEquationOfMotion) {
  std::mt19937_64 random(1);
  int exist = 0;
  for (int k = 0; k < 2000; ++k) {
    const Case c = random_case(random);
    const auto rub = annular_rub(c.rotor, c.clearance, c.mu, c.load, c.frequency);
    if (!rub) continue;
    ++exist;
    const Complex direction = rub->rotor / std::abs(rub->rotor);
    const Complex left = motion(c.rotor, rub->rotor, c.frequency);
    const Complex right = c.load - rub->force * Complex(1.0, c.mu) * direction;
    const double scale = c.load + std::abs(left) + rub->force * (1.0 + c.mu);
    ASSERT_LT(std::abs(left - right), kResidual * scale) << k;
    ASSERT_NEAR(std::abs(rub->rotor), c.clearance, 1e-15 * c.clearance * 4) << "on the ring";
    ASSERT_GE(rub->force, 0.0);
    ASSERT_EQ(rub->stator, Complex(0.0, 0.0));
  }
  EXPECT_GT(exist, 300);
  EXPECT_LT(exist, 1900);
}

TEST(AnnularRub, OnAnElasticRingSolvesBothEquationsOfMotion) {
  std::mt19937_64 random(2);
  int exist = 0;
  for (int k = 0; k < 2000; ++k) {
    const Case c = random_case(random);
    const auto rub = annular_rub(c.rotor, c.ring, c.clearance, c.mu, c.load, c.frequency);
    if (!rub) continue;
    ++exist;
    const Complex relative = rub->rotor - rub->stator;
    const Complex push = rub->force * Complex(1.0, c.mu) * relative / std::abs(relative);
    const Complex rotor = motion(c.rotor, rub->rotor, c.frequency) - (c.load - push);
    const Complex ring = motion(c.ring, rub->stator, c.frequency) - push;
    const double scale = c.load + std::abs(push) + std::abs(c.rotor.stiffness * rub->rotor) +
                         std::abs(c.ring.stiffness * rub->stator);
    ASSERT_LT(std::abs(rotor), kResidual * scale) << k;
    ASSERT_LT(std::abs(ring), kResidual * scale) << k;
    ASSERT_NEAR(std::abs(relative), c.clearance, 1e-11 * std::abs(rub->rotor) + 1e-15);
    ASSERT_GE(rub->force, 0.0);
  }
  EXPECT_GT(exist, 300);
}

// All zeros of the gap over the force, by scanning: |z_r - z_s| = delta_0 for a force lambda along
// the relative direction. That is where a rub exists, without the closed form.
int roots_by_scan(const Case& c, double most) {
  const double w = c.frequency;
  const Complex d = Complex(c.rotor.stiffness - c.rotor.mass * w * w, c.rotor.damping * w);
  // U = |D delta_0 + lambda (1 + i mu)| on a rigid ring.
  int roots = 0;
  double last = 0.0;
  for (int k = 0; k <= 200000; ++k) {
    const double force = most * k / 200000;
    const double miss = std::abs(d * c.clearance + force * Complex(1.0, c.mu)) - c.load;
    if (k > 0 && miss * last < 0.0) ++roots;
    last = miss;
  }
  return roots;
}

TEST(AnnularRub, ExistsWhereAScanOverTheForceFindsOne) {
  std::mt19937_64 random(3);
  int exist = 0, none = 0;
  for (int k = 0; k < 40; ++k) {
    const Case c = random_case(random);
    const bool exact = annular_rub(c.rotor, c.clearance, c.mu, c.load, c.frequency).has_value();
    EXPECT_EQ(exact, roots_by_scan(c, 2000.0) > 0) << k;
    ++(exact ? exist : none);
  }
  EXPECT_GT(exist, 5);
  EXPECT_GT(none, 5);
}

// ---------------------------------------------------------------- whip
// The whip's closed form against Runge-Kutta on its own equation.

constexpr BackwardWhip kWhip{2.0, 40.0, 2e5, 0.3, 0.5e-3};

double integrated(const BackwardWhip& w, double start, double t) {
  const auto rate = [&](double, const Eigen::VectorXd& y) {
    const double nu = y[0];
    Eigen::VectorXd dy(1);
    dy[0] = w.friction * nu * nu - w.damping / w.mass * nu - w.friction * w.stiffness / w.mass;
    return dy;
  };
  return test::runge_kutta(rate, 0.0, t, 20000, Eigen::VectorXd::Constant(1, start))[0];
}

TEST(BackwardWhip, AgreesWithRungeKutta) {
  for (const double start : {100.0, 316.0, 340.0, 360.0, 500.0, 900.0}) {
    const double limit = std::min(0.03, 0.9 * kWhip.blow_up(start));
    for (const double part : {0.1, 0.5, 1.0}) {
      const double t = part * limit, exact = integrated(kWhip, start, t);
      EXPECT_NEAR(kWhip.whirl_speed(start, t), exact, 1e-10 * std::abs(exact)) << start << " " << t;
    }
  }
}

}  // namespace
}  // namespace rotorub::oracle
