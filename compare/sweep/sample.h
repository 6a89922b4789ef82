// The points of a study: point i assigns a value to each varied key and so defines a scene. Each
// point is computed independently, without storing others, and equally on every computer.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/sweep/study_file.h"
#include "native_model/scene/reader.h"

namespace rotorub::sweep {

// 64 well-mixed bits from `x` (step and output function of SplitMix64).
std::uint64_t mixed(std::uint64_t x);
// The same for three numbers; their order matters.
std::uint64_t mixed(std::uint64_t a, std::uint64_t b, std::uint64_t c);

// A random permutation of 0 .. n-1 without storage: each element is computed independently.
//
// A Feistel network of kRounds rounds on the smallest even number of bits that holds n, keyed by
// SplitMix64; it is iterated until the result is below n (cycle walking; Black and Rogaway, Ciphers
// with arbitrary finite domains, 2002). It uses only integers, so it is equal on every computer.
class Permutation {
 public:
  // n: >= 1.
  Permutation(std::uint64_t n, std::uint64_t key);
  // The element at `place`; both are in [0, n).
  std::uint64_t at(std::uint64_t place) const;

 private:
  static constexpr int kRounds = 6;
  std::uint64_t once(std::uint64_t x) const;
  std::uint64_t n_, key_;
  int half_bits_ = 1;
};

// Points of Sobol's sequence, with the direction numbers of Joe and Kuo (2008; Boost.Random). Among
// the first 2^m points, every elementary box of the first two keys has its share.
//
// One coordinate per key, as 64 bits after the binary point. index: >= 0; 0 is the origin.
// Thread-safe.
class Sobol {
 public:
  static constexpr std::size_t kMostKeys = 3667;
  explicit Sobol(std::size_t keys);  // in [1, kMostKeys]
  std::vector<std::uint64_t> at(std::int64_t index) const;

 private:
  std::size_t keys_;
  // [bit][key]: the change caused by each bit of the Gray code of the index.
  std::vector<std::vector<std::uint64_t>> directions_;
};

// Order of the points:
//   grid             the last [[vary]] varies fastest
//   latin_hypercube  as drawn: each range is divided into `runs` equal cells (of the logarithm,
//                    with spacing = "log"); point i lies in cell P_k(i) of key k, P_k a random
//                    order, at a random place within it
//   list             as written, or the rows of its file
//   random           each key independently, by SplitMix64
//   sobol            Sobol's sequence from its origin, with the bits of each key flipped by the
//                    seed (a digital shift, which keeps the points evenly distributed)
// For a drawn point each key has a share in [0, 1), which selects one of its values or whole
// numbers, or a quantile of its distribution, or a place in its range.
class Sample {
 public:
  explicit Sample(const Study& study);
  std::int64_t size() const { return size_; }
  // One value per [[vary]]. index: in [0, size).
  std::vector<Value> at(std::int64_t index) const;

 private:
  std::vector<double> shares(std::int64_t index) const;  // of a drawn point

  const Study* study_;
  std::int64_t size_ = 0;
  std::vector<Permutation> orders_;  // for a Latin hypercube
  std::optional<Sobol> sobol_;
};

// The value at the fraction `share` of the range; exactly `from` at 0 and `to` at 1.
double between(const Vary& vary, double share);

// The overrides of a scene that set these values, one per [[vary]], and the keys coupled to them.
std::vector<std::string> changes_of(const Study& study, const std::vector<Value>& values);

// Makes the scene of a point of a study.
class PointScenes {
 public:
  // overrides: from the command line, applied after the study's own. Throws scene::SceneError, also
  // if one of them sets a varied key.
  PointScenes(const Study& study, std::span<const std::string> overrides);

  const Study& study() const { return *study_; }
  const Sample& sample() const { return sample_; }
  const std::string& scene_text() const { return variants_.text(); }

  // Thread safe. Throws scene::SceneError.
  scene::Scene at(std::int64_t index) const {
    return scene_at(index, study_->engine == EngineKind::kMujoco);
  }
  // The scene in which the only [[vary]] of the study has this value, SI.
  scene::Scene with_value(double value) const;
  // With its text, also for a native study: for a scene that is saved.
  scene::Scene whole_at(std::int64_t index) const { return scene_at(index, true); }

  // Throws scene::SceneError if the first, the middle and the last point are all refused, because
  // such a study would have no results.
  void check() const;

 private:
  scene::Scene scene_at(std::int64_t index, bool with_text) const;

  const Study* study_;
  Sample sample_;
  scene::Variants variants_;
};

// The errors of a scene on one line, for a row of the results.
std::string reason_of(const scene::SceneError& error);

}  // namespace rotorub::sweep
