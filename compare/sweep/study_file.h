// A study: one scene, what varies in it, which points are taken, and how each is run. Its file
// (TOML) is described in compare/sweep/README.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "native_model/scene/scene.h"

namespace rotorub::sweep {

// A value that a point gives to a key of the scene.
struct Value {
  std::string text;              // as in an override, table.key=text; a number in SI
  std::optional<double> number;  // SI; nothing: words, flags, lists
};

enum class Spacing { kLinear, kLog };

// Either values, or the range [from, to].
struct Vary {
  std::string key;                // "contact.friction", "force[0].amplitude"
  std::vector<std::string> also;  // further keys that get the same value
  std::vector<Value> values;      // empty: the range
  double from = 0.0, to = 0.0;    // SI
  std::int64_t count = 0;         // >= 1: of a grid, of values or over the range
  Spacing spacing = Spacing::kLinear;
  std::string unit;  // SI, for headings; empty: none
};

enum class SampleKind { kGrid, kLatinHypercube, kList };

enum class EngineKind { kNative, kMujoco };

struct Study {
  std::filesystem::path scene;  // absolute, or from the current folder
  SampleKind kind = SampleKind::kGrid;
  std::int64_t runs = 0;   // of a Latin hypercube, >= 1
  std::uint64_t seed = 0;  // of a Latin hypercube
  std::vector<Vary> vary;  // one or more
  EngineKind engine = EngineKind::kNative;
  std::optional<scene::Integrator> integrator;  // default: that of the point's scene
  std::optional<scene::ContactModel> contact;   // of MuJoCo; default: that of the point's scene
  // Points run one by one, so that none of their columns is empty that a run could fill.
  bool all_figures = false;
  std::vector<std::string> overrides;  // run.step and run.end, where the study gives them
  std::string text;                    // of the file

  bool varies(const std::string& key) const;
};

// Points that a study may have: their numbers and a bit for each fit into memory.
inline constexpr std::int64_t kMostPoints = 1'000'000'000;

// Throws scene::SceneError with everything that is wrong.
Study read_study(const std::filesystem::path& file);

}  // namespace rotorub::sweep
