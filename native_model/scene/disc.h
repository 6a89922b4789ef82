// Discs described in engineering terms: dimensions and density, unbalance, balance quality grade.
#pragma once

#include <optional>
#include <string_view>

#include "native_model/scene/rotor.h"

namespace rotorub::scene {

// The value in m/s of a balance grade such as "G 2.5" or "G2.5", which is 2.5 mm/s: eccentricity
// times angular speed (ISO 21940-11:2016, table 1). Any number > 0 is accepted, not only the
// standard's steps. Returns nothing if the text is not a grade.
std::optional<double> balance_quality(std::string_view grade);

// Computes mass, Jt, Jp and eccentricity from the other keys, for a scene without diagnostics.
void complete_discs(Rotor& rotor);

}  // namespace rotorub::scene
