#include "native_model/rotor/stiffness_map.h"

#include <algorithm>
#include <cmath>

#include "native_model/rotor/campbell.h"
#include "native_model/rotor/refusal.h"
#include "native_model/rotor/whirl_system.h"

namespace rotorub {

std::optional<StiffnessMap> stiffness_map(const scene::Scene& scene) {
  constexpr int kEachWay = 24, kDecades = 3;
  if (!scene.rotor.geometry) return std::nullopt;
  const auto& bearings = scene.rotor.geometry->bearings;
  if (std::ranges::any_of(bearings, &scene::ShaftBearing::follows_speed)) return std::nullopt;
  const auto first = std::ranges::find_if(
      bearings, [](const scene::ShaftBearing& b) { return b.stiffness.x() > 0.0; });
  if (first == bearings.end()) return std::nullopt;

  const double sense = scene.rotor.speed < 0.0 ? -1.0 : 1.0;
  StiffnessMap map;
  map.own = first->stiffness.x();
  for (int k = -kEachWay; k <= kEachWay; ++k) {
    const double factor = std::pow(10.0, static_cast<double>(kDecades * k) / kEachWay);
    scene::Scene held = scene;
    for (scene::ShaftBearing& bearing : held.rotor.geometry->bearings) {
      bearing.stiffness *= factor;
    }
    map.stiffness.push_back(factor * map.own);
    try {
      map.critical.push_back(critical_speeds(whirl_system(held), sense));
    } catch (const RotorNotSolvable&) {
      map.critical.emplace_back();  // springs beyond what the matrices bear
    }
  }
  return map;
}

}  // namespace rotorub
