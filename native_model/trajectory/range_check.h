// Checks whether rotor and ring are still within range of their supports. Beyond it the model no
// longer describes the machine, and a run ends with Status::kOutOfRange.
#pragma once

#include <optional>
#include <string>

#include "native_model/model/model.h"

namespace rotorub {

// How deep the rotor may penetrate a ring: by the ring's clearance, or by the larger of its
// clearance and its contact radius. The latter stands for the thickness of a soft ring, which no
// scene states; beyond it the rotor went through the ring.
enum class RingDepth { kClearance, kThickness };

// Reason why the configuration q (nq values) is out of range; empty if it is not:
// - The ring is displaced along an axis of its actuator by the magnets' air gap or more.
// - The ring has reached the end of its squeeze film (SqueezeFilmLaw::kReach of its clearance).
// - The rotor penetrates a ring by more than that ring's `depth`.
// - A rotor without a ring is further away than any machine is large, so nothing holds it.
// Cheap enough for every step, without allocation if the answer is empty.
std::optional<std::string> out_of_range(const Model& model, const double* q,
                                        RingDepth depth = RingDepth::kClearance);

}  // namespace rotorub
