// Roots of functions of one variable, and sampling that lets a search by signs miss none.
#pragma once

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace rotorub {

// Root of a function between two points, by algorithm 748 of Alefeld, Potra and Shi from
// Boost.Math. f_lo, f_hi: the values at the ends, of opposite sign or 0. Returns the remaining
// bracket, at whose ends the signs differ and whose width is a few units of round-off, or `least`
// if that is larger. No allocation.
template <class F>
std::pair<double, double> root(F&& f, double lo, double hi, double f_lo, double f_hi,
                               double least = 0.0) {
  std::uintmax_t evaluations = 200;
  const auto close = [least](double a, double b) {
    return b - a <= std::max(least, 2.0 * std::numeric_limits<double>::epsilon() * std::abs(b));
  };
  return boost::math::tools::toms748_solve(f, lo, hi, f_lo, f_hi, close, evaluations);
}

// Inserts points so that f is monotone between neighbours, and a search by signs does not miss a
// pair of roots between two samples. Appends the extremes of f in [a, b] to x, y, ascending. A
// cubic with given end values and slopes is monotone if no slope opposes the rise or exceeds three
// times it (Fritsch and Carlson 1980); otherwise the interval is halved. Between slopes of opposite
// sign, Brent's minimisation from Boost.Math finds the extreme.
template <class F>
void find_extremes(F& f, double a, double f_a, double b, double f_b, std::vector<double>& x,
                   std::vector<double>& y, int halvings = 6) {
  constexpr double kSlope = 1e-5;  // relative to the interval, for finite differences
  constexpr double kFlat = 1e-9;   // relative to the values: round-off of rise and slopes
  constexpr int kBits = std::numeric_limits<double>::digits / 2;
  const double size = kFlat * std::max(std::abs(f_a), std::abs(f_b)), rise = f_b - f_a;
  const double left = (f(a + kSlope * (b - a)) - f_a) / kSlope,
               right = (f_b - f(b - kSlope * (b - a))) / kSlope;
  if (!std::isfinite(rise) || !std::isfinite(left) || !std::isfinite(right)) return;
  if (std::max({std::abs(rise), std::abs(left), std::abs(right)}) <= size) return;
  if (left * right < 0.0) {
    const double sense = left > 0.0 ? -1.0 : 1.0;
    std::uintmax_t evaluations = 100;
    const auto [place, value] = boost::math::tools::brent_find_minima(
        [&](double at) { return sense * f(at); }, a, b, kBits, evaluations);
    x.push_back(place);
    y.push_back(sense * value);
    return;
  }
  const auto monotone = [rise](double slope) {
    return slope * rise >= 0.0 && std::abs(slope) <= 3.0 * std::abs(rise);
  };
  if ((monotone(left) && monotone(right)) || halvings == 0) return;
  const double middle = 0.5 * (a + b), f_middle = f(middle);
  find_extremes(f, a, f_a, middle, f_middle, x, y, halvings - 1);
  x.push_back(middle);
  y.push_back(f_middle);
  find_extremes(f, middle, f_middle, b, f_b, x, y, halvings - 1);
}

// Samples f at x, ascending, into y, and inserts the points of find_extremes.
template <class F>
void sample_with_extremes(F&& f, std::vector<double>& x, std::vector<double>& y) {
  std::vector<double> places, values;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double value = f(x[k]);
    if (k > 0) find_extremes(f, places.back(), values.back(), x[k], value, places, values);
    places.push_back(x[k]);
    values.push_back(value);
  }
  x.swap(places);
  y.swap(values);
}

// sum a_i x^i, i <= degree.
struct Polynomial {
  static constexpr int kMaxDegree = 14;
  int degree = 0;
  std::array<double, kMaxDegree + 1> a{};
  double operator()(double x) const;
};

// Sign of the polynomial at 0.
enum class RootStart {
  kAnywhere,   // given by a_0
  kBelowZero,  // a_0 > 0 would be round-off
};

// The least x in (0, 1] at which p changes from negative to zero or positive, to round-off; empty
// if there is none. Bernstein coefficients bound the polynomial, so that double roots are found
// too.
std::optional<double> first_crossing(const Polynomial& p, RootStart start);

}  // namespace rotorub
