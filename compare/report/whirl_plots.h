// The page's plots of whirl: full spectrum, waterfall and Poincare points of each run, and its
// distance from the first run.
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

// Hz, over the whole run, signed; 0 for a rotor at rest or a run without rows.
double mean_spin(const Trajectory& run);
inline constexpr std::size_t kLeastSpectrumRows = 64;
inline constexpr std::size_t kPlotBuckets = 600;  // for impacts and distances: 1200 points

// {"spectrum": {"f": [Hz], "y": [um]}, "waterfall": {"t": [s, s], "f": [Hz, Hz], "rows", "columns",
// "low", "high" (log10 um), "levels": base64 with one byte per cell, rows by rising time, columns
// by rising frequency}, "poincare": {"x", "y"} um, "residual": {"t", "y"} um or null, "orders",
// "cascade": run_up_plots.h}. Members are null if the run is too short for them. limit: Hz, to
// either side.
nlohmann::json whirl_data(const Trajectory& run, const Trajectory* first, double limit);

// "spectrum" in this: of z (m) at even intervals of h (s), to `limit` (Hz) on either side.
nlohmann::json spectrum_data(const std::vector<std::complex<double>>& z, double h, double limit);
// "residual" in this: um over s.
nlohmann::json distance_data(const std::vector<double>& t, const std::vector<double>& distance);

}  // namespace rotorub
