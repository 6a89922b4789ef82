// A cascade: full spectra over the speed of a run-up. At evenly spaced speeds, it takes the orbit
// of eight turns around the time when the run has that speed, under a Hann window as in
// full_spectrum (orbit.h). The frequencies may be arbitrarily dense: between those of the stretch
// the same transform is evaluated.
#pragma once

#include <cstddef>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

struct Cascade {
  static constexpr double kTurns = 8.0;
  std::vector<double> t;          // s, one per row
  std::vector<double> speed;      // rad/s, absolute values, ascending
  std::vector<double> frequency;  // Hz, evenly spaced, symmetric about 0 (backward whirl negative)
  std::vector<double> amplitude;  // m, rows x frequencies
};

// `rows` speeds among those where a stretch fits into the run and the run's rows are dense enough
// to distinguish whirls. Of a speed that occurs several times, the first time is used. Up to
// `highest` (Hz) to either side. Empty if the run is not a run-up.
Cascade cascade(const Trajectory& run, std::size_t rows, std::size_t frequencies, double highest);

}  // namespace rotorub
