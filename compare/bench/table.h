// The bench of a scene as text for the terminal.
#pragma once

#include <string>

#include "compare/bench/scene_bench.h"

namespace rotorub::bench {

// The fastest engine at each level of error with the others' ratios to it, then one line for each
// engine and setting: order, cost of a step, its most exact point, failures.
std::string bench_table(const SceneBench& bench);

// Engines that are not here, and why; empty where all are.
std::string missing_text();

}  // namespace rotorub::bench
