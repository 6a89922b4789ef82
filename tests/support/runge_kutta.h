// The classical fourth-order Runge-Kutta method, for trajectories that are independent of the
// integrators under test.
#pragma once

#include <Eigen/Core>

namespace rotorub::test {

// One step of y' = rate(t, y).
template <typename Rate>
Eigen::VectorXd runge_kutta(const Rate& rate, double t, double h, const Eigen::VectorXd& y) {
  const Eigen::VectorXd k1 = rate(t, y);
  const Eigen::VectorXd k2 = rate(t + 0.5 * h, Eigen::VectorXd(y + 0.5 * h * k1));
  const Eigen::VectorXd k3 = rate(t + 0.5 * h, Eigen::VectorXd(y + 0.5 * h * k2));
  const Eigen::VectorXd k4 = rate(t + h, Eigen::VectorXd(y + h * k3));
  return y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

// `steps` steps from t to `end`.
template <typename Rate>
Eigen::VectorXd runge_kutta(const Rate& rate, double t, double end, int steps, Eigen::VectorXd y) {
  const double h = (end - t) / steps;
  for (int k = 0; k < steps; ++k) y = runge_kutta(rate, t + k * h, h, y);
  return y;
}

}  // namespace rotorub::test
