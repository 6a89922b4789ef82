// The rows that a run is judged by.
#pragma once

#include <cstddef>
#include <vector>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

inline constexpr std::size_t kRows = 50000;  // at most: every step, or every so many of them

// Times of rows: every step, or every so many so that there are at most `rows`, and the scene's
// requested times.
std::vector<double> dense_times(const scene::Run& run, std::size_t rows);

// The rows of a trajectory at the given times (those that it has), everything else as it is.
Trajectory rows_at(const Trajectory& trajectory, const std::vector<double>& times);

}  // namespace rotorub
