// Names shared by the FMU's binary and its description.
#pragma once

#include <string>
#include <vector>

#include "native_model/scene/adjustable.h"
#include "native_model/scene/reader.h"

namespace rotorub::fmi {

inline constexpr const char* kSceneFile = "scene.toml";  // in the folder resources

// instantiationToken in FMI 3.0, guid in FMI 2.0.
inline std::string token_of(const scene::Scene& scene) {
  return "{rotorub-" + scene::scene_hash(scene) + "}";
}

// The parameters: the adjustable numbers of the scene and its further speeds.
inline std::vector<scene::Adjustable> parameters_of(const scene::Scene& scene) {
  std::vector<scene::Diagnostic> diagnostics;
  const auto root = scene::parse_toml(scene.text, scene.name, diagnostics);
  if (!root) return {};
  std::vector<scene::Adjustable> all = scene::adjustable_numbers(*root);
  const std::vector<scene::Adjustable> speeds = scene::speeds_beside_the_rotors(*root);
  all.insert(all.end(), speeds.begin(), speeds.end());
  return all;
}

// Value references: 0 is the time, followed by the inputs of StepwiseRun from 1, then all its
// outputs, and then the parameters.
inline constexpr unsigned kFirstInput = 1;

}  // namespace rotorub::fmi
