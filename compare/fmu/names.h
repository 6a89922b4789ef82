// What the FMU's binary and its description have to agree on.
#pragma once

#include <string>

#include "native_model/scene/reader.h"

namespace rotorub::fmi {

inline constexpr const char* kSceneFile = "scene.toml";  // in the folder resources

// instantiationToken of FMI 3.0, guid of FMI 2.0.
inline std::string token_of(const scene::Scene& scene) {
  return "{rotorub-" + scene::scene_hash(scene) + "}";
}

// Value references: 0 is the time; then the inputs of StepwiseRun in their order, from 1; then its
// outputs.
inline constexpr unsigned kFirstInput = 1;

}  // namespace rotorub::fmi
