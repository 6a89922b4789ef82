// Cases as a result: text for a terminal of 80 columns, and JSON.
#pragma once

#include <vector>

#include "compare/check/scene_check.h"
#include "compare/result/result.h"

namespace rotorub::check {

// For people, whether the native cases hold, and one line per scene with one column per engine;
// below, every violation and every refusal with its reason. cases: of each scene, in the order of
// the engines.
//
// {"cases": [{"scene", "engine", "outcome", "rule", "value", "limit", "reason", "rules": [...]}]};
// value and limit are null where nothing is measured. rules has the same keys for every rule.
result::Section result_of(const std::vector<Case>& cases);

}  // namespace rotorub::check
