// The root of a function between two points of opposite sign, to the last bit but a few: algorithm
// 748 of Alefeld, Potra and Shi, from Boost.Math.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <boost/math/tools/toms748_solve.hpp>

namespace rotorub {

// f_lo, f_hi: the values at the ends, of opposite sign or 0. Gives the bracket that is left, as
// wide as round-off or `least`: the sign changes between its ends. No allocation.
template <class F>
std::pair<double, double> root(F&& f, double lo, double hi, double f_lo, double f_hi,
                               double least = 0.0) {
  std::uintmax_t evaluations = 200;
  const auto close = [least](double a, double b) {
    return b - a <= std::max(least, 2.0 * std::numeric_limits<double>::epsilon() * std::abs(b));
  };
  return boost::math::tools::toms748_solve(f, lo, hi, f_lo, f_hi, close, evaluations);
}

}  // namespace rotorub
