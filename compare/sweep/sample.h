// The points of a study: point i gives each varied key a value. Every point is computed by itself,
// in no memory, and the same on every machine.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/sweep/permutation.h"
#include "compare/sweep/study_file.h"

namespace rotorub::sweep {

// Order of the points:
//   grid             the last [[vary]] runs fastest
//   latin_hypercube  as drawn: each range is cut into `runs` equal cells (of the logarithm, with
//                    spacing = "log"); point i lies in cell P_k(i) of key k, P_k a random order, at
//                    a random place within it
//   list             as written
class Sample {
 public:
  explicit Sample(const Study& study);
  std::int64_t size() const { return size_; }
  // One value for each [[vary]]. index: in [0, size).
  std::vector<Value> at(std::int64_t index) const;

 private:
  Value cell_value(std::size_t k, std::int64_t index) const;

  const Study* study_;
  std::int64_t size_ = 0;
  std::vector<Permutation> orders_;  // of a Latin hypercube
};

// The value `share` in [0, 1] of the way; exactly `from` and `to` at the ends.
double between(const Vary& vary, double share);

}  // namespace rotorub::sweep
