// The points of a study: point i gives each varied key a value, and so a scene. Every point is
// computed by itself, in no memory, and the same on every machine.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/sweep/sobol.h"
#include "compare/sweep/study_file.h"
#include "native_model/scene/reader.h"

namespace rotorub::sweep {

// 64 well-mixed bits of `x` (SplitMix64's step and output function).
std::uint64_t mixed(std::uint64_t x);
// The same of several numbers, in their order.
std::uint64_t mixed(std::uint64_t a, std::uint64_t b, std::uint64_t c);

// A random order of 0 .. n-1 that needs no memory: each element is computed by itself.
//
// A Feistel network of kRounds rounds on the smallest even number of bits that holds n, keyed by
// SplitMix64, walked along its cycle until it falls below n (Black and Rogaway, Ciphers with
// arbitrary finite domains, 2002). Integers alone: the same on every machine.
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

// Order of the points:
//   grid             the last [[vary]] runs fastest
//   latin_hypercube  as drawn: each range is cut into `runs` equal cells (of the logarithm, with
//                    spacing = "log"); point i lies in cell P_k(i) of key k, P_k a random order, at
//                    a random place within it
//   list             as written, or as the rows of its file
//   random           each key by itself, by SplitMix64
//   sobol            Sobol's sequence from its origin on, each key with the bits of the seed
//                    turned (a digital shift: what makes the points even stays)
// Of a drawn point each key has a share in [0, 1), and with it the place in its values, its whole
// numbers, its distribution or its range.
class Sample {
 public:
  explicit Sample(const Study& study);
  std::int64_t size() const { return size_; }
  // One value for each [[vary]]. index: in [0, size).
  std::vector<Value> at(std::int64_t index) const;

 private:
  std::vector<double> shares(std::int64_t index) const;  // of a drawn point

  const Study* study_;
  std::int64_t size_ = 0;
  std::vector<Permutation> orders_;  // of a Latin hypercube
  std::optional<Sobol> sobol_;
};

// The value `share` in [0, 1] of the way; exactly `from` and `to` at the ends.
double between(const Vary& vary, double share);

// From a point of a study to its scene.
class PointScenes {
 public:
  // `overrides`: of the command line, on top of the study's own. Throws scene::SceneError, also
  // where one of them sets what varies.
  PointScenes(const Study& study, std::span<const std::string> overrides);

  const Study& study() const { return *study_; }
  const Sample& sample() const { return sample_; }
  const std::string& scene_text() const { return variants_.text(); }

  // Thread safe. Throws scene::SceneError.
  scene::Scene at(std::int64_t index) const;
  // With its text, also of a native study: a scene that is kept.
  scene::Scene whole_at(std::int64_t index) const { return scene_at(index, true); }

  // Throws scene::SceneError where the first, the middle and the last point are all refused: a
  // study that nothing can come of.
  void check() const;

 private:
  scene::Scene scene_at(std::int64_t index, bool with_text) const;

  const Study* study_;
  Sample sample_;
  scene::Variants variants_;
};

// What is wrong with a scene, on one line, for a row of the results.
std::string reason_of(const scene::SceneError& error);

}  // namespace rotorub::sweep
