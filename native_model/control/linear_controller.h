// A linear law that is evaluated once per sample. From the sensor values y (p values) and the state
// x (n values) it computes the requested currents u (p values),
//
//   u_k = -(C x_k + D y_k),   x_{k+1} = A x_k + B y_k + K (u_k - c_k),
//
// where c are the currents after their limits. K is the anti-windup gain: it removes the effect of
// the part that the limits cut off (K. J. Astrom, B. Wittenmark, "Computer-Controlled Systems",
// 1997, section 3.5). At the first sample, and at the first one after the law was off, x = X y.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace rotorub {

struct LinearController {
  Eigen::MatrixXd a, b, c, d;  // n x n, n x p, p x n, p x p
  Eigen::MatrixXd back;        // K, n x p
  Eigen::MatrixXd start;       // X, n x p

  Eigen::Index states() const { return a.rows(); }
  Eigen::Index ports() const { return d.rows(); }
};

// p = 1: the law P + I/s + D s/(1 + T_d s), sampled every T (s). The derivative is the difference
// of two samples, and the integral contains the earlier samples only:
//   u_k = -(P y_k + D d_k + j_k),   j_{k+1} = j_k + T I (y_k + (u_k - c_k) / P),
//   d_k = (T_d d_{k-1} + y_k - y_{k-1}) / (T_d + T).
struct SampledPid {
  double proportional, integral, derivative, derivative_lag;  // A/m, A/(m s), A s/m, s
};
LinearController sampled_pid(const SampledPid& pid, double sample_time);

// p = 1: u = -H(z) y, H(z) = (b_0 + b_1 z^-1 + ..) / (a_0 + a_1 z^-1 + ..), a_0 not 0.
LinearController transfer_function(const std::vector<double>& numerator,
                                   const std::vector<double>& denominator);

// Matrices are given row by row. There are p ports, and n is the square root of the size of a.
LinearController state_space(const std::vector<double>& a, const std::vector<double>& b,
                             const std::vector<double>& c, const std::vector<double>& d,
                             Eigen::Index ports);

// A law with n states and p ports whose output is 0.
LinearController no_law(Eigen::Index states, Eigen::Index ports);

// Applies the same law to x and to y independently.
LinearController on_both_axes(const LinearController& of_one);

}  // namespace rotorub
