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

// What result_of() shows people, from that JSON, which may have been read from a file: without the
// rules. Throws std::exception for a key that is missing and for an engine that does not exist.
std::vector<Case> cases_of(const nlohmann::json& kept);

}  // namespace rotorub::check
