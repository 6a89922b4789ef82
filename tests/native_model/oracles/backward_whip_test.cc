// The whip's closed form against Runge-Kutta, first on its own equation, then on the polar
// equations of the rotor that it comes from.
#include "tests/support/oracles/backward_whip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/runge_kutta.h"

namespace rotorub::oracle {
namespace {

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

TEST(BackwardWhip, IsTheRotorSlidingRoundTheRing) {
  // Cartesian: m z'' + d z' + k z = N n + T e_t on |z| = delta_0, with N from the constraint and
  // T = -mu N for slip > 0. The orbit's speed after 10 ms is the closed form's.
  const BackwardWhip& w = kWhip;
  const double nu = 500.0;
  const auto rate = [&](double, const Eigen::VectorXd& y) {
    const Eigen::Vector2d z = y.head(2), v = y.tail(2), e = z.normalized(), t{-e.y(), e.x()};
    const Eigen::Vector2d own = -w.damping * v - w.stiffness * z;
    // e . z'' = -v_t^2 / |z| keeps the circle.
    const double whirl = t.dot(v);
    const double normal = own.dot(e) + w.mass * whirl * whirl / z.norm();
    Eigen::VectorXd dy(4);
    dy << v, (own - normal * e - w.friction * normal * t) / w.mass;
    return dy;
  };
  Eigen::VectorXd y(4);
  y << w.clearance, 0.0, 0.0, -nu * w.clearance;
  const double end = 2e-3;
  y = test::runge_kutta(rate, 0.0, end, 20000, y);
  const Eigen::Vector2d z = y.head(2), v = y.tail(2);
  EXPECT_NEAR(z.norm(), w.clearance, 1e-9 * w.clearance);
  const double speed = -(z.x() * v.y() - z.y() * v.x()) / z.squaredNorm();
  EXPECT_NEAR(w.whirl_speed(nu, end), speed, 1e-8 * speed);
  EXPECT_GT(speed, 1.15 * nu) << "the whip grows";
}

TEST(BackwardWhip, GrowsAboveItsThresholdAndDiesBelow) {
  const double threshold = kWhip.growth_threshold();
  EXPECT_GT(threshold, kWhip.natural_frequency());
  EXPECT_GT(integrated(kWhip, 1.001 * threshold, 1e-3), 1.001 * threshold);
  EXPECT_LT(integrated(kWhip, 0.999 * threshold, 1e-3), 0.999 * threshold);
  EXPECT_NEAR(kWhip.whirl_speed(threshold, 0.5), threshold, 1e-9 * threshold) << "stands still";
  EXPECT_TRUE(std::isinf(kWhip.blow_up(0.999 * threshold)));
  const double start = 1.5 * threshold, end = kWhip.blow_up(start);
  EXPECT_GT(kWhip.whirl_speed(start, end * (1.0 - 1e-6)), 1e3 * start);
}

TEST(BackwardWhip, WithoutDampingTheThresholdIsTheNaturalFrequency) {
  const BackwardWhip w{2.0, 0.0, 2e5, 0.3, 0.5e-3};
  EXPECT_DOUBLE_EQ(w.growth_threshold(), w.natural_frequency());
}

TEST(BackwardWhip, PressesFromTheNaturalFrequencyOn) {
  const double w = kWhip.natural_frequency();
  EXPECT_NEAR(kWhip.normal_force(w), 0.0, 1e-9);
  EXPECT_GT(kWhip.normal_force(1.01 * w), 0.0);
  EXPECT_LT(kWhip.normal_force(0.99 * w), 0.0) << "would have to pull: no contact";
  EXPECT_DOUBLE_EQ(kWhip.normal_force(2.0 * w), 3.0 * 2e5 * 0.5e-3);
}

}  // namespace
}  // namespace rotorub::oracle
