// The bench as JSON, as the contract names its keys; what is not there is null, never NaN.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "compare/bench/machine.h"
#include "compare/bench/scene_bench.h"

namespace rotorub::bench {

nlohmann::json point_json(const Point& point);
nlohmann::json bench_json(const Machine& machine, const std::vector<SceneBench>& benches);

}  // namespace rotorub::bench
