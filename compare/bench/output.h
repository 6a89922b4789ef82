// The bench as a result: JSON, text for the terminal, and the sections of the page.
#pragma once

#include <string>
#include <vector>

#include "compare/bench/scene_bench.h"
#include "compare/bench/soft_contact.h"
#include "compare/result/result.h"

namespace rotorub::bench {

// One scene. For people, the fastest engine at each level of error with the others' ratios to it;
// then one line per engine and setting with its order, cost per step, most accurate point and
// failures. In JSON, with the keys of the contract; missing values are null, never NaN. force_error
// and impulse_error are shares, lengths are in m.
result::Section scene_section(const SceneBench& bench);

// restitution: empty, or an additional table in JSON and on the page.
result::Section result_of(const Machine& machine, const std::vector<SceneBench>& benches,
                          const std::vector<RestitutionRow>& restitution);

// The engines that are not available, with the reasons. Empty if all are available.
std::string missing_text();

}  // namespace rotorub::bench
