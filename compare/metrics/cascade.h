// Full spectra over the speed of a run-up: a cascade. At speeds evenly apart the orbit of eight
// turns about the time when the run has that speed, under a Hann window, as full_spectrum
// (orbit.h), at frequencies as close as one likes: between those of the stretch it is the same
// transform.
#pragma once

#include <cstddef>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

struct Cascade {
  static constexpr double kTurns = 8.0;
  std::vector<double> t;          // s, of each row
  std::vector<double> speed;      // rad/s, size, ascending
  std::vector<double> frequency;  // Hz, even, as far backward (below 0) as forward
  std::vector<double> amplitude;  // m, rows x frequencies
};

// `rows` of them, of those that lie so far within the run that a stretch fits, and where its rows
// are dense enough to tell whirls apart; of speeds that the run has more than once the first time.
// Up to `highest` (Hz) either way. Empty: no run-up.
Cascade cascade(const Trajectory& run, std::size_t rows, std::size_t frequencies, double highest);

}  // namespace rotorub
