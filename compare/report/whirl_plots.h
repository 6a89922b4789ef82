// The page's plots of whirl: full spectrum, waterfall and Poincare points of each run, its distance
// from the first run, and for a run-up 1x, 2x and the cascade.
#pragma once

#include <complex>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Hz: the range of a run's spectra to either side of 0: 8 times its mean spin, or for a rotor at
// rest 160 over the length of the run.
double spectrum_reach(const Trajectory& run);

// Whether the spin speed changes by at least a tenth of the highest speed.
bool changes_speed(const Trajectory& run);

// Hz, over the whole run, signed; 0 for a rotor at rest or a run without rows.
double mean_spin(const Trajectory& run);
inline constexpr std::size_t kLeastSpectrumRows = 64;

// {"spectrum": a series of m over Hz, "waterfall": {"t": [s, s], "f": [Hz, Hz], "rows", "columns",
// and levels_data of m, rows by rising time, columns by rising frequency}, "poincare": {"x", "y"}
// m, "residual": a series of m over s or null, "orders": {"t": [s], "speed": [rad/s], "orders": the
// vectors of 1x and of 2x, each [real, imaginary] in m}, "cascade": {"t": [s], "speed": [rad/s],
// "f": [Hz of the first and of the last column], "columns", and levels_data of m, rows by rising
// speed}}. Members are null if the run is too short for them, the last two also if it is not a
// run-up. limit: Hz, to either side.
nlohmann::json whirl_data(const Trajectory& run, const Trajectory* first, double limit);

// "spectrum" in this: of z (m) at even intervals of h (s), to `limit` (Hz) on either side.
nlohmann::json spectrum_data(const std::vector<std::complex<double>>& z, double h, double limit);

}  // namespace rotorub
