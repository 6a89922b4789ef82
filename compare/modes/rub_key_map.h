// Which lasting rubs there are over any two keys of a scene.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "native_model/linear/rub_map.h"
#include "native_model/scene/reader.h"

namespace rotorub {

struct MapAxis {
  std::string key;   // "contact.clearance"
  std::string unit;  // SI; empty: a number
  std::vector<double> values;
};

// Of rotor.speed each load keeps its ratio to the spin (rub::at_speed).
inline constexpr const char* kSpeedKey = "rotor.speed";
inline constexpr const char* kFrictionKey = "contact.friction";

struct RubKeyMap {
  MapAxis across, up;
  std::vector<std::optional<rub::RubPoint>> points;  // up runs fastest; nothing: refused
  std::string refused;                               // why, of the first refused one

  RubKeyMap() = default;
  RubKeyMap(const rub::RubMap& map);  // NOLINT: is one, over speed and friction
  bool of_speed_and_friction() const { return across.key == kSpeedKey && up.key == kFrictionKey; }
  const std::optional<rub::RubPoint>& at(std::size_t across_k, std::size_t up_k) const {
    return points[across_k * up.values.size() + up_k];
  }
};

// A scene for each point; one that is refused has none. progress: the share done, may throw. Throws
// scene::SceneError where every point is refused.
RubKeyMap rub_key_map(const scene::Variants& scenes, const MapAxis& across, const MapAxis& up,
                      const std::function<void(double share)>& progress = {});

}  // namespace rotorub
