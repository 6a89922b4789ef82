// What the page's plots of a run-up show: 1x and 2x, and the cascade of full spectra.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Its spin goes from one speed to another, by a tenth of the faster one or more.
bool changes_speed(const Trajectory& run);

// {"t": [s], "speed": [rpm], "amplitude": [[um]], "phase": [[deg]], of 1x and of 2x}:
// metrics/orders.h; a phase goes on beyond half a turn. Null: no run-up.
nlohmann::json orders_data(const Trajectory& run);

// {"t": [s], "speed": [rpm], "f": [Hz of the first column, of the last], "columns", and
// levels_data: rows by rising speed}: metrics/cascade.h. Null: no run-up.
nlohmann::json cascade_data(const Trajectory& run);

}  // namespace rotorub
