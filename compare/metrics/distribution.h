// Distributions of contact forces and impulses over a run.
#pragma once

#include <cstddef>
#include <vector>

namespace rotorub {

// The number of values that reach `value`.
struct Exceedance {
  std::vector<double> value;       // descending
  std::vector<std::size_t> count;  // ascending, from 1
};
// If there are too many values for `most` points, points at about even steps of ln count, including
// the first and the last. most >= 2.
Exceedance exceedance(std::vector<double> values, std::size_t most);

// The share of time that y spends in each of `parts` equal parts of its range above 0, with y
// linear between the times t of the rows. Time at 0 belongs to none of them.
struct Histogram {
  double width = 0.0;         // of each part; the first begins at 0
  std::vector<double> share;  // of the whole time, per part
};
Histogram histogram(const std::vector<double>& t, const std::vector<double>& y, std::size_t parts);

}  // namespace rotorub
