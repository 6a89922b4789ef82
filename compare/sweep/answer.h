// The answer of a sweep in sentences: where its runs settle to which attractor, how many of them
// ended as asked, and the hardest impact.
#pragma once

#include <string>
#include <vector>

#include "compare/sweep/sample.h"
#include "compare/sweep/store.h"

namespace rotorub::sweep {

// At most three sentences. The first names the regions of the attractors: "Backward whip from
// contact.friction = 0.32 up, at every rotor.speed." In a grid, a region that begins or ends at one
// value of a key has this form; any other is given by its number of points and the ranges of the
// keys over them. store: must hold all points.
std::vector<std::string> answer_of(Store& store, const Study& study);

}  // namespace rotorub::sweep
