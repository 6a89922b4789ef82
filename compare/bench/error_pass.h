// The pass over the settings of a scene for their errors, with the output on.
#pragma once

#include <atomic>
#include <vector>

#include "compare/bench/point.h"
#include "compare/bench/progress.h"

namespace rotorub::bench {

// One run each. Series of one engine and setting also get their distance to their own finest step
// (Point::limit_error), which holds no error of the contact model.
std::vector<Point> error_pass(const std::vector<Setting>& settings, const Reference& reference,
                              const Progress& progress, const std::atomic<bool>* interrupt);

}  // namespace rotorub::bench
