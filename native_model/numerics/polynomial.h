// The first root of a polynomial in an interval, with nothing overlooked.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace rotorub {

// sum a_i x^i, i <= degree.
struct Polynomial {
  static constexpr int kMaxDegree = 14;
  int degree = 0;
  std::array<double, kMaxDegree + 1> a{};
  double operator()(double x) const;
};

// How the polynomial is known to begin at 0.
enum class RootStart {
  kAnywhere,   // a_0 says it
  kBelowZero,  // a_0 > 0 would be round-off
};

// The least x in (0, 1] at which p comes from below zero to zero or above, to round-off; empty:
// none. Bernstein's coefficients bound the polynomial, so that a double root is seen as well.
std::optional<double> first_crossing(const Polynomial& p, RootStart start);

}  // namespace rotorub
