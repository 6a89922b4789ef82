// The page of a bench: work-precision plots, errors against the step, stability maps, restitution.
#pragma once

#include <string>
#include <vector>

#include "compare/bench/machine.h"
#include "compare/bench/restitution.h"
#include "compare/bench/scene_bench.h"

namespace rotorub {

std::string bench_page(const bench::Machine& machine, const std::vector<bench::SceneBench>& benches,
                       const std::vector<bench::RestitutionRow>& restitution);

}  // namespace rotorub
