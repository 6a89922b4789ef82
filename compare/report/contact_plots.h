// How a run's contact forces and impulses are distributed, as the page draws it.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// gives: the contacts of the scene give, and their episodes are impacts however long they last;
// those of a soft contact beyond the window of impulses are a rub, and not counted.
//
// {"force": {"width": N, "share": [% of the whole time]}, "impulse": {"value": [mN s, descending],
// "count": [how many counted impacts reach it]}}; null in the place of what there is none of.
nlohmann::json contact_distribution(const Trajectory& run, std::size_t contact, bool gives);

}  // namespace rotorub
