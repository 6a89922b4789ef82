// Model error as JSON: {"modes": [...], "<figure>": share or null, ..., "figures": {"<figure>":
// {"values", "convergence", "last_change", "left", "error"}}, "reason" where there is nothing}.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "compare/model_error/model_error.h"

namespace rotorub {

nlohmann::json model_error_json(const ModelError& error);

}  // namespace rotorub
