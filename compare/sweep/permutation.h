// A random order of 0 .. n-1 that needs no memory: each element is computed by itself.
//
// A Feistel network of kRounds rounds on the smallest even number of bits that holds n, keyed by
// SplitMix64, walked along its cycle until it falls below n (Black and Rogaway, Ciphers with
// arbitrary finite domains, 2002). Integers alone: the same on every machine.
#pragma once

#include <cstdint>

namespace rotorub::sweep {

// 64 well-mixed bits of `x` (SplitMix64's step and output function).
std::uint64_t mixed(std::uint64_t x);
// The same of several numbers, in their order.
std::uint64_t mixed(std::uint64_t a, std::uint64_t b, std::uint64_t c);

class Permutation {
 public:
  // n: >= 1.
  Permutation(std::uint64_t n, std::uint64_t key);
  // The element at `place`, both in [0, n).
  std::uint64_t at(std::uint64_t place) const;

 private:
  static constexpr int kRounds = 6;
  std::uint64_t once(std::uint64_t x) const;
  std::uint64_t n_, key_;
  int half_bits_ = 1;
};

}  // namespace rotorub::sweep
