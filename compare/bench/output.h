// The bench as JSON and as text for the terminal.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "compare/bench/scene_bench.h"
#include "compare/bench/soft_contact.h"

namespace rotorub::bench {

// As the contract names its keys; what is not there is null, never NaN. force_error and
// impulse_error are shares, and lengths are in m.
nlohmann::json point_json(const Point& point);
// `restitution`: empty, or a table beside the scenes.
nlohmann::json bench_json(const Machine& machine, const std::vector<SceneBench>& benches,
                          const std::vector<RestitutionRow>& restitution);

// The fastest engine at each level of error with the others' ratios to it, then one line for each
// engine and setting: order, cost of a step, its most exact point, failures.
std::string bench_table(const SceneBench& bench);

// Engines that are not here, and why; empty where all are.
std::string missing_text();

}  // namespace rotorub::bench
