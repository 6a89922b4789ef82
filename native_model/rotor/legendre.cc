#include "native_model/rotor/legendre.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace rotorub {
namespace {

// P_0 .. P_{count-1} by (n + 1) P_{n+1} = (2 n + 1) xi P_n - n P_{n-1}.
Eigen::VectorXd legendre(int count, double xi) {
  Eigen::VectorXd p(count);
  p[0] = 1.0;
  if (count > 1) p[1] = xi;
  for (int n = 1; n + 1 < count; ++n) {
    p[n + 1] = ((2 * n + 1) * xi * p[n] - n * p[n - 1]) / (n + 1);
  }
  return p;
}

}  // namespace

LegendreValues integrated_legendre(int count, double xi) {
  assert(count >= 1 && xi >= -1.0 && xi <= 1.0);
  const Eigen::VectorXd p = legendre(count + 2, xi);

  // int P_n = (P_{n+1} - P_{n-1}) / (2 n + 1); one more than asked for, used by the next line.
  Eigen::VectorXd first(count + 1);
  first[0] = 1.0 + xi;
  for (int n = 1; n <= count; ++n) first[n] = (p[n + 1] - p[n - 1]) / (2 * n + 1);

  // The same identity again; n = 0 and n = 1 have terms that do not vanish at -1.
  Eigen::VectorXd second(count);
  second[0] = 0.5 * (1.0 + xi) * (1.0 + xi);
  if (count > 1) second[1] = (first[2] - first[0]) / 3.0;
  for (int n = 2; n < count; ++n) second[n] = (first[n + 1] - first[n - 1]) / (2 * n + 1);

  return {p.head(count), first.head(count), second};
}

GaussRule gauss_legendre(int n) {
  assert(n >= 1);
  constexpr int kNewtonSteps = 8;  // quadratic from a start good to 1e-3: 5 reach round-off
  GaussRule rule{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (int i = 0; i < n; ++i) {
    // Tricomi's start for the i-th root of P_n, then Newton with (1 - x^2) P_n' = n (P_{n-1} - x
    // P_n).
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    double slope = 0.0;
    for (int step = 0; step < kNewtonSteps; ++step) {
      const Eigen::VectorXd p = legendre(n + 1, x);
      slope = n * (p[n - 1] - x * p[n]) / (1.0 - x * x);
      x -= p[n] / slope;
    }
    rule.node[i] = x;
    rule.weight[i] = 2.0 / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace rotorub
