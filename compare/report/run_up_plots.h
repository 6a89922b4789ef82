// The page's plots of a run-up: 1x and 2x, and the cascade of full spectra.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// True if the spin speed changes by at least a tenth of the highest speed.
bool changes_speed(const Trajectory& run);

// {"t": [s], "speed": [rpm], "amplitude": [[um]], "phase": [[deg]], of 1x and of 2x}:
// metrics/orders.h. Phases continue beyond half a turn. null if the run is not a run-up.
nlohmann::json orders_data(const Trajectory& run);

// {"t": [s], "speed": [rpm], "f": [Hz of the first and of the last column], "columns", and
// levels_data with rows by rising speed}: metrics/cascade.h. null if the run is not a run-up.
nlohmann::json cascade_data(const Trajectory& run);

}  // namespace rotorub
