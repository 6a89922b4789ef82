// The periodic rubs of `rotorub modes --periodic` for people and as JSON.
#pragma once

#include "compare/modes/periodic_rubs.h"
#include "compare/result/result.h"

namespace rotorub {

// {"periodic_rubs": {"rubs": [{"kind", "starts": [names], "period": s, "order" (periods of the
// loads, or turns of a free spin, in one period; null if nothing depends on time), "contact" (its
// name; null for a single one), "whirl": rad/s, "multiplier", "stable", "residual",
// "return_error", "run_time": s, "mean_force", "largest_force": N, "largest_impulse": N s,
// "impacts", "contact_share", "stuck_share", "contacts": [the keys from "whirl" and from
// "mean_force" on, of each contact]}], "without": [{"start", "reason"}],
// "refused": why there can be none, or null}}
result::Section periodic_rubs_result(const PeriodicRubs& rubs);

}  // namespace rotorub
