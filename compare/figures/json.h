// The figures of a run as JSON, and what its keys mean. A number that is not finite becomes null.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "compare/metrics/metrics.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {

// Figures (SI), settled state and residuals of a run.
nlohmann::json metrics_json(const Metrics& metrics);

// Its `residuals`.
nlohmann::json residuals_json(const Residuals& residuals);

// The keys of metrics_json.
std::span<const ColumnMeaning> metric_keys();

}  // namespace rotorub
