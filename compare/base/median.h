// The median of measured times.
#pragma once

#include <algorithm>
#include <cassert>
#include <vector>

namespace rotorub {

// At least one value; of an even number the mean of the middle two.
inline double median(std::vector<double> values) {
  assert(!values.empty());
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

}  // namespace rotorub
