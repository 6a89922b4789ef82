#include "compare/sweep/sobol.h"

#include <boost/random/sobol.hpp>
#include <cassert>

namespace rotorub::sweep {
namespace {

constexpr int kBits = 31;  // of an index; kMostPoints needs 30

}  // namespace

// The Gray code of 2^b - 1 is bit b - 1 alone, so these points are the direction numbers.
Sobol::Sobol(std::size_t keys) : keys_(keys) {
  assert(keys >= 1 && keys <= kMostSobolKeys);
  boost::random::sobol engine(keys);
  for (int bit = 0; bit < kBits; ++bit) {
    engine.seed((std::uint64_t{2} << bit) - 2);  // it skips the origin
    std::vector<std::uint64_t>& direction = directions_.emplace_back();
    for (std::size_t k = 0; k < keys; ++k) direction.push_back(engine());
  }
}

std::vector<std::uint64_t> Sobol::at(std::int64_t index) const {
  std::vector<std::uint64_t> point(keys_, 0);
  auto code = static_cast<std::uint64_t>(index);
  code ^= code >> 1u;
  for (std::size_t bit = 0; code != 0; ++bit, code >>= 1u) {
    if ((code & 1u) == 0) continue;
    for (std::size_t k = 0; k < keys_; ++k) point[k] ^= directions_[bit][k];
  }
  return point;
}

}  // namespace rotorub::sweep
