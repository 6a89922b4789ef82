// Settings that a scene passes to a user's control library.
#pragma once

#include <optional>
#include <string>

namespace rotorub::scene {

// One entry of [controller.config] or [magnetic_control.config].
struct ConfigEntry {
  std::string key;
  std::optional<std::string> text;  // absent: the value is a number
  double number = 0.0;
};

}  // namespace rotorub::scene
