// The page of a bench: work-precision plots, errors over the step, stability maps, restitution.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "compare/bench/scene_bench.h"
#include "compare/bench/soft_contact.h"

namespace rotorub {

// The data of the plots (page/precision.js) from the bench's JSON, which may have been read from a
// file. scene: a member of "scenes" in bench.json. {"clearance", "series": [{"engine", "setting",
// "family", "order" or null, "points": [{"step" (0: none), "label", "error", "limit" (0: none),
// "ms", "low", "high", "outcome"}]}]}, errors in m.
nlohmann::json precision_plots(const nlohmann::json& scene);

std::string bench_page(const bench::Machine& machine, const std::vector<bench::SceneBench>& benches,
                       const std::vector<bench::RestitutionRow>& restitution);

}  // namespace rotorub
