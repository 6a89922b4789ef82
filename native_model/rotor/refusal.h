// Refusals of a rotor that only its matrices can show, with the name of the scene's file.
#pragma once

#include <utility>
#include <vector>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// action(), with the file put into every diagnostic of a scene::SceneError that has none.
template <typename Action>
auto with_file_name(const scene::Scene& scene, const Action& action) {
  try {
    return action();
  } catch (const scene::SceneError& error) {
    std::vector<scene::Diagnostic> diagnostics = error.diagnostics();
    for (scene::Diagnostic& diagnostic : diagnostics) {
      if (diagnostic.file.empty() && !scene.name.empty()) diagnostic.file = scene.name + ".toml";
    }
    throw scene::SceneError(std::move(diagnostics));
  }
}

}  // namespace rotorub
