// The gap of a run, with what the rows alone do not show: the touch of every rigid impact between
// them.
#pragma once

#include "compare/report/pack/track.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Those of a contact that count, in order of time.
std::vector<Impact> counted_impacts(const Trajectory& run, std::size_t contact);

// Rows of gap and gap rate. In the rigid law every impact in between joins them twice, at gap 0,
// with the rate before it and after it: the pieces between two bounces are then arcs that touch 0,
// however coarse the rows are. A soft contact's impact is an episode, which its rows show.
// Tolerance of each: the greater of `least` (m) and `share` of the gap.
Samples gap_samples(const Trajectory& run, std::size_t contact, double least, double share);

}  // namespace rotorub
