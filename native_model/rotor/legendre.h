// Legendre polynomials P_n on [-1, 1], their integrals from -1, and Gauss-Legendre quadrature:
// the local functions of the Ritz ansatz. Identities: Abramowitz and Stegun, chapters 8 and 25.4.
#pragma once

#include <Eigen/Core>

namespace rotorub {

// P_n and its first and second integral from -1 to xi, for n = 0 .. count - 1.
// For n >= 2 both integrals vanish at xi = 1, so that they are bubbles of one element.
struct LegendreValues {
  Eigen::VectorXd value;   // P_n(xi)
  Eigen::VectorXd first;   // int P_n
  Eigen::VectorXd second;  // int int P_n
};

// xi in [-1, 1], count >= 1.
LegendreValues integrated_legendre(int count, double xi);

// sum_i weight_i f(node_i) = int_{-1}^{1} f for polynomials up to degree 2 n - 1.
struct GaussRule {
  Eigen::VectorXd node;    // n, ascending
  Eigen::VectorXd weight;  // n, sum 2
};

// n >= 1 points.
GaussRule gauss_legendre(int n);

}  // namespace rotorub
