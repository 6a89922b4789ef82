// The lasting rubs over any two keys of a scene.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "native_model/linear/rub_map.h"
#include "native_model/scene/reader.h"

namespace rotorub {

struct MapAxis {
  std::string key;   // "contact.clearance"
  std::string unit;  // SI; empty if dimensionless
  std::vector<double> values;
};

// {"key", "unit", "values"}
nlohmann::json axis_json(const MapAxis& axis);

// If rotor.speed varies, each load keeps its ratio to the spin (rub::at_speed).
inline constexpr const char* kSpeedKey = "rotor.speed";
inline constexpr const char* kFrictionKey = "contact.friction";

struct RubKeyMap {
  MapAxis across, up;
  std::vector<std::optional<rub::RubPoint>> points;  // up varies fastest; empty where refused
  std::string refused;                               // the reason of the first refusal

  RubKeyMap() = default;
  // NOLINT: an implicit conversion from a map over speed and friction
  RubKeyMap(const rub::RubMap& map);
  bool of_speed_and_friction() const { return across.key == kSpeedKey && up.key == kFrictionKey; }
  const std::optional<rub::RubPoint>& at(std::size_t across_k, std::size_t up_k) const {
    return points[across_k * up.values.size() + up_k];
  }
};

// Makes a scene for each point; a refused scene leaves its point empty. progress receives the
// fraction done and may throw. Throws scene::SceneError if every point is refused.
RubKeyMap rub_key_map(const scene::Variants& scenes, const MapAxis& across, const MapAxis& up,
                      const std::function<void(double share)>& progress = {});

}  // namespace rotorub
