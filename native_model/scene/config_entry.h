// What a library of the user's is given by a scene.
#pragma once

#include <optional>
#include <string>

namespace rotorub::scene {

// One entry of [controller.config] or [magnetic_control.config].
struct ConfigEntry {
  std::string key;
  std::optional<std::string> text;  // absent: a number
  double number = 0.0;
};

}  // namespace rotorub::scene
