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

// m/s, a bending motion that no machine survives; the control of an unstable machine may add energy
// at every impact, although the ring keeps the rotor in place.
inline constexpr double kFastestBending = 1e5;

// Reason why the state q, v (nq values each) is out of range; empty if it is not:
// - The ring is displaced along an axis of its actuator by the magnets' air gap or more.
// - The ring has reached the end of its squeeze film (SqueezeFilmLaw::kReach of its clearance).
// - The rotor penetrates a ring by more than that ring's `depth`.
// - A bending mode is deflected by more than Model::reach or faster than kFastestBending.
// Cheap enough for every step, without allocation if the answer is empty.
std::optional<std::string> out_of_range(const Model& model, const double* q, const double* v,
                                        RingDepth depth = RingDepth::kClearance);

}  // namespace rotorub
