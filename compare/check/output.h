// Cases as text for a terminal of 80 columns, and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "compare/base/palette.h"
#include "compare/check/scene_check.h"

namespace rotorub::check {

// One line per scene and one column per engine; below, every violation and every refusal with its
// reason. The cases of a scene must be adjacent.
std::string table(const std::vector<Case>& cases, const Palette& palette = Palette());

// {"cases": [{"scene", "engine", "outcome", "rule", "value", "limit", "reason", "rules": [...]}]};
// value and limit are null where nothing is measured. rules has the same keys for every rule.
nlohmann::json cases_json(const std::vector<Case>& cases);

}  // namespace rotorub::check
