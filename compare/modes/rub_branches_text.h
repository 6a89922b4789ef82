// The branches of `rotorub modes --periodic --across` for people, as JSON and as CSV.
#pragma once

#include <string>

#include "compare/modes/rub_branches.h"
#include "compare/result/result.h"

namespace rotorub {

// {"rub_branches": {"across", "up" (null for a single diagram): {"key", "unit", "values"},
// "branches": [{"up", "from": value of the key where it was found, "starts": [names], "order",
// "ends": [why, why], "points": [{"value", "point": "fold" ... or null, "kind", "stable",
// "multiplier", "period", "whirl", "mean_force", "largest_force", "largest_impulse", "impacts",
// "contact_share", "stuck_share", "amplitude", "contact"}]}],
// "without": [{"value", "up", "start", "reason"}]}}; SI units.
// People see the ends and the named points of each branch.
result::Section rub_branches_result(const std::string& name, const RubBranches& all);

// A line per point: branch (from 1), the keys that vary, and the keys of "points".
std::string rub_branches_csv(const RubBranches& all);

}  // namespace rotorub
