// The page of a bench: work-precision plots, errors over the step, stability maps, restitution.
#pragma once

#include <string>
#include <vector>

#include "compare/bench/scene_bench.h"
#include "compare/bench/soft_contact.h"

namespace rotorub {

std::string bench_page(const bench::Machine& machine, const std::vector<bench::SceneBench>& benches,
                       const std::vector<bench::RestitutionRow>& restitution);

}  // namespace rotorub
