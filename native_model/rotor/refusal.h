// Rejects a rotor for errors that only its matrices can show, and reports the place in the scene
// file.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/record.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// The matrices cannot be solved to working precision.
class RotorNotSolvable : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Returns the result of an iteration; throws RotorNotSolvable if it is empty.
template <typename Found>
Found found_by(std::optional<Found> iteration,
               const char* refusal = "no eigenvalues can be found") {
  if (!iteration) throw RotorNotSolvable(refusal);
  return *std::move(iteration);
}

// Runs action(). Its SceneErrors get the place of their keys in the scene file; RotorNotSolvable
// becomes a SceneError for the whole rotor.
template <typename Action>
auto with_place(const scene::Scene& scene, const Action& action) {
  try {
    return action();
  } catch (const scene::SceneError& error) {
    throw scene::SceneError(scene::placed(scene, error.diagnostics()));
  } catch (const RotorNotSolvable& error) {
    throw scene::SceneError(scene::placed(
        scene,
        {{"", 0, scene.rotor.modal ? "rotor.modal" : "rotor",
          std::string(error.what()) +
              ": its masses, stiffnesses and lengths lie too many orders of magnitude apart"}}));
  }
}

}  // namespace rotorub
