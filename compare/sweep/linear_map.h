// The linear map of a study: for each of its points, which lasting rubs there are and which are
// stable, by eigenvalues (native_model/linear/rub_map.h). No run is needed for it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/sweep/sample.h"
#include "native_model/linear/rub_map.h"

namespace rotorub::sweep {

struct LinearMap {
  std::vector<std::optional<rub::RubPoint>> points;  // in the study's order; nothing: refused
  std::string refused;                               // why, of the first refused one
  bool any() const;
};

// Of a grid over contact.friction and at least one other key, and not too many values of the
// others: the rotor is assembled once for each of these. Otherwise without points.
LinearMap linear_map(const PointScenes& scenes);

inline constexpr std::int64_t kMostSystems = 1000;

}  // namespace rotorub::sweep
