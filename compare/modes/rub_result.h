// The lasting rubs of a rotor as tables, sentences and JSON (README.md). A person reads the whirl
// in Hz on a page.
#pragma once

#include <vector>

#include "compare/modes/rotor_analysis.h"
#include "compare/modes/rub_analysis.h"
#include "compare/result/result.h"

namespace rotorub {

// The rubs at one speed and friction, the free orbit and the attractors.
result::Section rub_point_result(const rub::RubPoint& point);
// The same with the whirl of rotor and ring, and with torsion and the spin free.
result::Section rub_result(const RubAnalysis& analysis);

// The rubs of every contact, below the place of each speed, and the periodic rubs.
std::vector<result::Part> rubs_parts(const RotorAnalysis& analysis);

}  // namespace rotorub
