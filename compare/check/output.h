// Cases as a result: text for a terminal of 80 columns, a page, and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
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

// Reads the cases back from that JSON, for example from a kept file. They have what result_of()
// shows people, and no rules. Throws std::exception if a key is missing or an engine does not
// exist.
std::vector<Case> cases_of(const nlohmann::json& kept);

}  // namespace rotorub::check
