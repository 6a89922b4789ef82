// The bifurcation diagram for the sweep's page (compare/sweep/bifurcation.h).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "compare/sweep/bifurcation.h"

namespace rotorub {

// {"key": {"name", "unit", "log"}, "up", "down": [{"value": in the key's unit, "refused",
// "continued", "x": [um], "y": [um], "period": turns, "exponent": 1/s or null}], "note": a sentence
// on where the values start}. A periodic motion has the places of one period.
nlohmann::json bifurcation_data(const sweep::Study& study, const sweep::Sample& sample,
                                const sweep::Bifurcation& diagram);

}  // namespace rotorub
