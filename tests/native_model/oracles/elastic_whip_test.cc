// The whip's closed form against Runge-Kutta on its own equation.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "tests/support/oracles/elastic_whip.h"
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

}  // namespace
}  // namespace rotorub::oracle
