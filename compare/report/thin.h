// Fewer points for a plot that looks the same: extremes survive, so that no impact is lost.
#pragma once

#include <cstddef>
#include <vector>

namespace rotorub {

// Indices (ascending, without doubles) of the rows kept of y[first, last): the first, the last, and
// the least and the greatest value of each of `buckets` parts of equal length. All rows where
// there are no more than 2 buckets + 2 of them. Asserts a range within y and buckets > 0.
std::vector<std::size_t> thin(const std::vector<double>& y, std::size_t first, std::size_t last,
                              std::size_t buckets);

}  // namespace rotorub
