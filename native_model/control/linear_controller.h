// A linear law that is asked once a sample: from what the sensors show, y (p values), the currents
// that it asks for, u (p values), with the state x (n values),
//
//   u_k = -(C x_k + D y_k),   x_{k+1} = A x_k + B y_k + K (u_k - c_k),
//
// c the currents as their limits leave them: K takes back what those cut off (K. J. Astrom, B.
// Wittenmark, "Computer-Controlled Systems", 1997, section 3.5). Its first sample, and the first
// after it was off, has x = X y.
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

// p = 1: the proportional-integral-derivative law P + I/s + D s/(1 + T_d s) sampled every T (s),
// the derivative by the difference of two samples, the integral by what the samples before it
// showed:
//   u_k = -(P y_k + D d_k + j_k),   j_{k+1} = j_k + T I (y_k + (u_k - c_k) / P),
//   d_k = (T_d d_{k-1} + y_k - y_{k-1}) / (T_d + T).
struct SampledPid {
  double proportional, integral, derivative, derivative_lag;  // A/m, A/(m s), A s/m, s
};
LinearController sampled_pid(const SampledPid& pid, double sample_time);

// p = 1: u = -H(z) y, H(z) = (b_0 + b_1 z^-1 + ..) / (a_0 + a_1 z^-1 + ..), a_0 not 0.
LinearController transfer_function(const std::vector<double>& numerator,
                                   const std::vector<double>& denominator);

// Matrices row by row; p ports, n = the root of a's size.
LinearController state_space(const std::vector<double>& a, const std::vector<double>& b,
                             const std::vector<double>& c, const std::vector<double>& d,
                             Eigen::Index ports);

// Of n states and p ports, that asks for nothing.
LinearController no_law(Eigen::Index states, Eigen::Index ports);

// The same law on x and on y, each for itself.
LinearController on_both_axes(const LinearController& of_one);

}  // namespace rotorub
