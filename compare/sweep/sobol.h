// Points of Sobol's sequence, with the direction numbers of Joe and Kuo (2008; Boost.Random). Among
// the first 2^m points, every elementary box of the first two keys has its share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rotorub::sweep {

inline constexpr std::size_t kMostSobolKeys = 3667;

// One coordinate per key, as 64 bits after the binary point. index: >= 0; 0 is the origin.
// Thread-safe.
class Sobol {
 public:
  explicit Sobol(std::size_t keys);  // in [1, kMostSobolKeys]
  std::vector<std::uint64_t> at(std::int64_t index) const;

 private:
  std::size_t keys_;
  // [bit][key]: the change caused by each bit of the Gray code of the index.
  std::vector<std::vector<std::uint64_t>> directions_;
};

}  // namespace rotorub::sweep
