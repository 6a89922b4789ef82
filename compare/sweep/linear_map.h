// The linear map of a study: the lasting rubs at each of its points and their stability, from
// eigenvalues (native_model/linear/rub_map.h). It needs no run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/sweep/sample.h"
#include "native_model/linear/rub_map.h"

namespace rotorub::sweep {

struct LinearMap {
  std::vector<std::optional<rub::RubPoint>> points;  // in the study's order; empty where refused
  std::string refused;                               // the reason of the first refusal
  bool any() const;
};

// For a grid over contact.friction and at least one other key, with at most kMostSystems values of
// the others, because each of these needs its own rotor. Otherwise the result has no points.
LinearMap linear_map(const PointScenes& scenes);

inline constexpr std::int64_t kMostSystems = 1000;

}  // namespace rotorub::sweep
