// What the page's plots of whirl show: full spectrum, waterfall and Poincare points of each run,
// and how far each is from the first.
#pragma once

#include <complex>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Hz, how far to either side spectra of a run are worth showing: 8 times its mean spin; of a rotor
// at rest 160 over the run.
double spectrum_reach(const Trajectory& run);

// Hz, over the whole run, signed; 0 for a rotor at rest or without rows.
double mean_spin(const Trajectory& run);
inline constexpr std::size_t kLeastSpectrumRows = 64;
inline constexpr std::size_t kPlotBuckets = 600;  // of impacts, of distances: 1200 points

// Of a run: {"spectrum": {"f": [Hz], "y": [um]}, "waterfall": {"t": [s, s], "f": [Hz, Hz], "rows",
// "columns", "low", "high" (log10 um), "levels": base64 of a byte a cell, rows from the first time,
// columns from the lowest frequency}, "poincare": {"x", "y"} um, "residual": {"t", "y"} um or
// null, "orders", "cascade": run_up_plots.h}. Null members where a run is too short. `limit`:
// Hz, shown to either side.
nlohmann::json whirl_data(const Trajectory& run, const Trajectory* first, double limit);

// "spectrum" of it: of z (m) at even times h (s) apart, to `limit` (Hz) on either side.
nlohmann::json spectrum_data(const std::vector<std::complex<double>>& z, double h, double limit);
// "residual" of it: um over s.
nlohmann::json distance_data(const std::vector<double>& t, const std::vector<double>& distance);

}  // namespace rotorub
