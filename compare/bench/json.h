// The bench as JSON, as the contract names its keys; what is not there is null, never NaN.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "compare/bench/machine.h"
#include "compare/bench/restitution.h"
#include "compare/bench/scene_bench.h"

namespace rotorub::bench {

// The contract's keys; force_error and impulse_error are shares, and lengths are in m.
nlohmann::json point_json(const Point& point);
// `restitution`: empty, or a table beside the scenes.
nlohmann::json bench_json(const Machine& machine, const std::vector<SceneBench>& benches,
                          const std::vector<RestitutionRow>& restitution);

}  // namespace rotorub::bench
