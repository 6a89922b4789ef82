// Names shared by the FMU's binary and its description.
#pragma once

#include <string>

#include "native_model/scene/reader.h"

namespace rotorub::fmi {

inline constexpr const char* kSceneFile = "scene.toml";  // in the folder resources

// instantiationToken in FMI 3.0, guid in FMI 2.0.
inline std::string token_of(const scene::Scene& scene) {
  return "{rotorub-" + scene::scene_hash(scene) + "}";
}

// Value references: 0 is the time, followed by the inputs of StepwiseRun from 1 and then its
// outputs.
inline constexpr unsigned kFirstInput = 1;

}  // namespace rotorub::fmi
