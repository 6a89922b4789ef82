// Refusals of a rotor that only its matrices can show, at the place in the scene's file.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/record.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// Matrices that cannot be solved to working precision.
class RotorNotSolvable : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// What an iteration found; refuses the rotor where it found nothing.
template <typename Found>
Found found_by(std::optional<Found> iteration,
               const char* refusal = "no eigenvalues can be found") {
  if (!iteration) throw RotorNotSolvable(refusal);
  return *std::move(iteration);
}

// action(), with its refusals at the place of their keys, and with what cannot be solved as a
// refusal of the whole rotor.
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
