// How contact forces and impulses are distributed over a run.
#pragma once

#include <cstddef>
#include <vector>

namespace rotorub {

// How many of the values reach `value`.
struct Exceedance {
  std::vector<double> value;       // descending
  std::vector<std::size_t> count;  // ascending, from 1
};
// Of so many values that `most` points do not do, points at about even steps of ln count; the first
// and the last are among them. most >= 2.
Exceedance exceedance(std::vector<double> values, std::size_t most);

// The share of the time that y spends in each of even parts of its range above 0, of rows at times
// t between which it goes straight. Time at 0 is in none of them.
struct Histogram {
  double width = 0.0;         // of a part, the first from 0
  std::vector<double> share;  // of the whole time, each
};
Histogram histogram(const std::vector<double>& t, const std::vector<double>& y, std::size_t parts);

}  // namespace rotorub
