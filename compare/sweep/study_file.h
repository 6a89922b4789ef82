// A study: one scene, the keys that vary in it, the choice of points and how each is run. Its file
// (TOML) is described in compare/sweep/README.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/sweep/distribution.h"
#include "native_model/scene/scene.h"

namespace rotorub::sweep {

// A value of a key of the scene at a point.
struct Value {
  std::string text;              // as in an override table.key=text; numbers in SI
  std::optional<double> number;  // SI; empty for words, flags and lists
};

enum class Spacing { kLinear, kLog };

// A list of values, a range [from, to] or a distribution.
struct Vary {
  std::string key;                // "contact.friction", "force[0].amplitude"
  std::vector<std::string> also;  // further keys that get the same value
  std::vector<Value> values;      // empty: the range
  double from = 0.0, to = 0.0;    // SI
  std::int64_t count = 0;         // >= 1, in a grid: number of values, or of points in the range
  Spacing spacing = Spacing::kLinear;
  bool whole = false;  // the range contains only whole numbers, both ends included
  std::optional<Distribution> distribution;  // in a study that draws its points
  std::optional<double> start;               // of an optimisation, SI, in [from, to]
  std::string unit;                          // SI, for headings; empty if none

  bool has_numbers() const;  // false if a value is a word, a flag or a list
};

enum class SampleKind { kGrid, kLatinHypercube, kList, kRandom, kSobol };

// Whether `runs` points are drawn instead of given.
inline bool is_drawn(SampleKind kind) {
  return kind != SampleKind::kGrid && kind != SampleKind::kList;
}

enum class EngineKind { kNative, kMujoco };

// The table [statistics] of a study, which requests statistics of groups of its points.
struct Statistics {
  std::vector<std::string> figures{"status", "attractor",
                                   "peak_impulse"};  // columns of the results
  std::vector<std::size_t> by;  // indices in Study::vary; a group has one value of each
  std::vector<double> quantiles{0.05, 0.5, 0.95};  // in (0, 1)
  double confidence = 0.95;                        // of the bounds, in (0, 1)
};

struct Study {
  std::filesystem::path scene;  // absolute, or relative to the current folder
  SampleKind kind = SampleKind::kGrid;
  std::int64_t runs = 0;   // number of drawn points, >= 1
  std::uint64_t seed = 0;  // for drawn points
  std::vector<Vary> vary;  // at least one
  EngineKind engine = EngineKind::kNative;
  std::optional<scene::Integrator> integrator;  // default: from the point's scene
  std::optional<scene::ContactModel> contact;   // for MuJoCo; default: from the point's scene
  std::vector<std::string> overrides;           // run.step and run.end if the study sets them
  std::optional<Statistics> statistics;
  std::string points;  // text of the list's file; may be empty
  std::string text;    // of the study's file
  // The part that the results depend on: the text without [statistics], and the points.
  std::string identity;

  bool varies(const std::string& key) const;
};

// The largest number of points of a study: their indices and one bit for each must fit into memory.
inline constexpr std::int64_t kMostPoints = 1'000'000'000;

// The part of a study's text that the results of a sweep depend on. Tables that only process the
// results may change.
std::string study_identity(const std::string& text);

// kOptimise: for a study with a table [optimise], which compare/optimise reads. Its keys have
// ranges of numbers, and [sample] may be omitted.
enum class StudyUse { kSweep, kOptimise };

// Throws scene::SceneError with all errors.
Study read_study(const std::filesystem::path& file, StudyUse use = StudyUse::kSweep);

}  // namespace rotorub::sweep
