// What the plots of a bench (page/bench.js) show, from its JSON (compare/bench/json.h): from a
// bench that has just run and from one that was kept.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "compare/bench/scene_bench.h"
#include "compare/bench/soft_contact.h"

namespace rotorub {

// scene: a member of "scenes" of bench_json. {"clearance", "series": [{"engine", "setting",
// "family", "order" or null, "points": [{"step" (0: none), "label", "error", "limit" (0: none),
// "ms", "low", "high", "outcome"}]}]}, errors in m.
nlohmann::json precision_plots(const nlohmann::json& scene);

// The page of a bench: work-precision plots, errors against the step, stability maps, restitution.

std::string bench_page(const bench::Machine& machine, const std::vector<bench::SceneBench>& benches,
                       const std::vector<bench::RestitutionRow>& restitution);

}  // namespace rotorub
