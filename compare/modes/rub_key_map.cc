#include "compare/modes/rub_key_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "native_model/linear/rub_system.h"
#include "native_model/rotor/refusal.h"
#include "native_model/scene/diagnostic.h"

namespace rotorub {

RubKeyMap::RubKeyMap(const rub::RubMap& map)
    : across{kSpeedKey, "rad/s", map.speeds},
      up{kFrictionKey, "", map.frictions},
      points(map.points.begin(), map.points.end()) {}

nlohmann::json axis_json(const MapAxis& axis) {
  return {{"key", axis.key}, {"unit", axis.unit}, {"values", axis.values}};
}

RubKeyMap rub_key_map(const scene::Variants& scenes, const MapAxis& across, const MapAxis& up,
                      const std::function<void(double)>& progress) {
  RubKeyMap map;
  map.across = across;
  map.up = up;
  std::optional<scene::SceneError> first;
  for (std::size_t i = 0; i < across.values.size(); ++i) {
    if (progress) progress(static_cast<double>(i) / static_cast<double>(across.values.size()));
    for (const double value : up.values) {
      std::optional<double> speed;
      std::vector<std::string> changes;
      for (const auto& [key, of] :
           {std::pair(across.key, across.values[i]), std::pair(up.key, value)}) {
        if (key == kSpeedKey) {
          speed = of;
        } else {
          changes.push_back(fmt::format("{}={}", key, of));
        }
      }
      map.points.emplace_back();
      try {
        scene::Scene scene = scenes.scene(changes, false);
        // A steady rub does not depend on the start, which might not fit into a different ring.
        scene.initial = {};
        for (auto& at : scene.auxiliary)
          if (at.stator) at.stator->position.setZero();
        map.points.back() = with_place(scene, [&] {
          rub::RubSystem system = rub::rub_system(scene);
          if (speed) system = rub::at_speed(std::move(system), *speed);
          return rub::RubStudy(system).at(system.friction);
        });
      } catch (const scene::SceneError& error) {
        if (!first) first = error;
      }
    }
  }
  if (first && std::none_of(map.points.begin(), map.points.end(),
                            [](const auto& point) { return point.has_value(); }))
    throw *first;
  if (first) map.refused = scene::to_string(first->diagnostics().front());
  return map;
}

}  // namespace rotorub
