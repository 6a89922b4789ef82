// A study: one scene, what varies in it, which points are taken, and how each is run. Its file
// (TOML) is described in compare/sweep/README.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/sweep/distribution.h"
#include "compare/sweep/study_statistics.h"
#include "native_model/scene/scene.h"

namespace rotorub::sweep {

// A value that a point gives to a key of the scene.
struct Value {
  std::string text;              // as in an override, table.key=text; a number in SI
  std::optional<double> number;  // SI; nothing: words, flags, lists
};

enum class Spacing { kLinear, kLog };

// Values, the range [from, to], or a distribution.
struct Vary {
  std::string key;                // "contact.friction", "force[0].amplitude"
  std::vector<std::string> also;  // further keys that get the same value
  std::vector<Value> values;      // empty: the range
  double from = 0.0, to = 0.0;    // SI
  std::int64_t count = 0;         // >= 1: of a grid, of values or over the range
  Spacing spacing = Spacing::kLinear;
  bool whole = false;  // the range has whole numbers alone, both ends included
  std::optional<Distribution> distribution;  // of a study whose points are drawn
  std::optional<double> start;               // of an optimisation, SI, within [from, to]
  std::string unit;                          // SI, for headings; empty: none
};

enum class SampleKind { kGrid, kLatinHypercube, kList, kRandom, kSobol };

// Whether the points are drawn, `runs` of them, and not given.
inline bool is_drawn(SampleKind kind) {
  return kind != SampleKind::kGrid && kind != SampleKind::kList;
}

enum class EngineKind { kNative, kMujoco };

struct Study {
  std::filesystem::path scene;  // absolute, or from the current folder
  SampleKind kind = SampleKind::kGrid;
  std::int64_t runs = 0;   // of drawn points, >= 1
  std::uint64_t seed = 0;  // of drawn points
  std::vector<Vary> vary;  // one or more
  EngineKind engine = EngineKind::kNative;
  std::optional<scene::Integrator> integrator;  // default: that of the point's scene
  std::optional<scene::ContactModel> contact;   // of MuJoCo; default: that of the point's scene
  std::vector<std::string> overrides;           // run.step and run.end, where the study gives them
  std::optional<Statistics> statistics;
  std::string points;    // text of the list's file; empty: none
  std::string text;      // of the file
  std::string identity;  // what results depend on: all of the text but [statistics], and the points

  bool varies(const std::string& key) const;
};

// Points that a study may have: their numbers and a bit for each fit into memory.
inline constexpr std::int64_t kMostPoints = 1'000'000'000;

// What of a study's text the results of a sweep depend on: statistics of them may change, and what
// else is done with the keys.
std::string study_identity(const std::string& text);

// kOptimise: the keys of a table [optimise], which is read elsewhere (compare/optimise): they have
// ranges of numbers, and [sample] may be left out.
enum class StudyUse { kSweep, kOptimise };

// Throws scene::SceneError with everything that is wrong.
Study read_study(const std::filesystem::path& file, StudyUse use = StudyUse::kSweep);

}  // namespace rotorub::sweep
