// A measured run in compare.json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "compare/measured/measured_run.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {

// {"file", "samples", "interval", "alignment", "columns", "figures", "remarks"}, SI.
nlohmann::json measured_json(const MeasuredRun& run);

// Its keys, for columns.json and documents.
std::span<const ColumnMeaning> measured_keys();

}  // namespace rotorub
