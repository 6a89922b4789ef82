// The rotor's places once a turn of its spin: a point for a synchronous motion, k points for one
// that repeats after k turns, a closed curve for two frequencies, a cloud for chaos (Poincare
// section at the keyphasor).
#pragma once

#include <complex>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// x + i y of the rotor at the contact, m, whenever spin_angle passes a multiple of 2 pi, either
// way, from `from` (s) on. Linear between rows; empty for a rotor at rest.
std::vector<std::complex<double>> poincare_points(const Trajectory& run, double from);

}  // namespace rotorub
