// A horizontal rotor of segments that drops into two auxiliary bearings.
#pragma once

#include <string>
#include <vector>

#include "native_model/scene/reader.h"
#include "native_model/scene/scene.h"

namespace rotorub::test {

inline scene::Scene segments_in_two_catchers(const std::vector<std::string>& overrides = {}) {
  return scene::read_scene(
      std::string(ROTORUB_SOURCE_DIR) + "/tests/compare/engine/two_catchers.toml", overrides);
}

}  // namespace rotorub::test
