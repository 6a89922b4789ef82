// The result of tune as JSON and as text for the terminal.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "compare/base/palette.h"
#include "compare/tune/tune.h"

namespace rotorub::tune {

// With the keys of the contract; missing values are null.
nlohmann::json tune_json(const TuneResult& result);
std::string tune_table(const TuneResult& result, const Palette& palette = Palette());

}  // namespace rotorub::tune
