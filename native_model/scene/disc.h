// A disc in an engineer's words: dimensions and density, unbalance, balance quality grade.
#pragma once

#include <optional>
#include <string_view>

#include "native_model/scene/checker.h"

namespace rotorub::scene {

// m/s, of "G 2.5" or "G2.5", which is 2.5 mm/s: eccentricity times angular speed (ISO
// 21940-11:2016, table 1; any number > 0 is taken, not the standard's steps alone). Nothing: no
// such text.
std::optional<double> balance_quality(std::string_view grade);

// Cross-checks of [[rotor.disc]].
void check_discs(const Checker& check, const RotorGeometry& shaft);

// mass, Jt, Jp and eccentricity from the other words, of a scene that was found sound.
void complete_discs(Rotor& rotor);

}  // namespace rotorub::scene
