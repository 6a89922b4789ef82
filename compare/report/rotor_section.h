// The report's section on the free rotor: Campbell diagram with the scene's speed, and whirl shapes
// at that speed (modes_page.h).
#pragma once

#include <nlohmann/json.hpp>

#include "native_model/scene/scene.h"

namespace rotorub {

struct RotorSection {
  nlohmann::json
      data;  // for the script page/campbell.js; null where the rotor has no whirl to show
  nlohmann::json values;  // for the template rotor.html: "has_campbell", "has_shapes", "beyond",
                          // "speed", "refusal"
};
RotorSection rotor_section(const scene::Scene& scene);

}  // namespace rotorub
