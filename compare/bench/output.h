// The bench as JSON and as text for the terminal.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "compare/bench/scene_bench.h"
#include "compare/bench/soft_contact.h"

namespace rotorub::bench {

// With the keys of the contract. Missing values are null, never NaN. force_error and impulse_error
// are shares, lengths are in m.
nlohmann::json point_json(const Point& point);
// restitution: empty, or an additional table.
nlohmann::json bench_json(const Machine& machine, const std::vector<SceneBench>& benches,
                          const std::vector<RestitutionRow>& restitution);

// The fastest engine at each level of error with the others' ratios to it; then one line per engine
// and setting with its order, cost per step, most accurate point and failures.
std::string bench_table(const SceneBench& bench);

// The engines that are not available, with the reasons. Empty if all are available.
std::string missing_text();

}  // namespace rotorub::bench
