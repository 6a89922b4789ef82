// The periodic rubs of `rotorub modes --periodic` for people and as JSON.
#pragma once

#include "compare/modes/periodic_rubs.h"
#include "compare/result/result.h"

namespace rotorub {

// {"rubs": [{"kind", "source": words, "starts": [names], "period": s, "order" (periods of the
// loads, or turns of a free spin, in one period; null if nothing depends on time), "contact" (its
// name; null for a single one), "whirl": rad/s, "multipliers": [[real, imaginary]], "multiplier"
// (the largest size), "stable", "residual", "return_error", "run_time": s, "mean_force",
// "largest_force": N, "largest_impulse": N s, "impacts", "contact_share", "stuck_share",
// "contacts": [the keys "whirl" and from "mean_force" on, of each contact]}],
// "periodic_rubs": {"without": [{"start", "reason"}], "refused": why there can be none, or null}}
result::Section periodic_rubs_result(const PeriodicRubs& rubs);

}  // namespace rotorub
