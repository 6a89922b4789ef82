// The branches of periodic motions under a bifurcation diagram, stable and unstable
// (modes/rub_branches.h): the rotor's positions once per turn, as the diagram has them.
#pragma once

#include <atomic>
#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "compare/modes/rub_branches.h"
#include "compare/sweep/sample.h"

namespace rotorub::sweep {

struct MotionBranches {
  RubBranches found;
  std::string refused;  // the reason if there is no branch, otherwise empty
};

// Values of the key at which runs begin that may settle to a motion; the branches lie between the
// first and the last.
inline constexpr std::size_t kMostStarts = 5;

// The study must have a bifurcation diagram (no_bifurcation). Ends early if interrupted.
MotionBranches motion_branches(const PointScenes& scenes, const std::atomic<bool>* interrupt,
                               const std::function<void(double)>& progress);

// m, x + i y of the rotor at the first contact whenever its mark passes +x in one period, in the
// order of passing. Empty if the period is not a whole number of turns.
std::vector<std::complex<double>> places_of(const PeriodicRub& rub);

}  // namespace rotorub::sweep
