// The result of tune as JSON, as the contract names its keys; what is not there is null.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "compare/tune/tune.h"

namespace rotorub::tune {

nlohmann::json tune_json(const TuneResult& result);

}  // namespace rotorub::tune
