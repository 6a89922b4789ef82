// The bifurcation diagram of a study of one key: the position of the rotor once per turn, for
// ascending and then for descending values. Each value starts where the previous one ended, so that
// a motion is followed as long as it exists. Where the two directions differ, two motions coexist.
#pragma once

#include <atomic>
#include <complex>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/sweep/sample.h"

namespace rotorub::sweep {

struct BranchPoint {
  std::int64_t point = 0;  // index in the study's order
  std::string refused;     // the reason, if there is no result; else empty
  bool continued = false;  // starts where the previous value ended, not at the scene's own start
  // m, x + i y of the rotor at the contact whenever its mark passes +x (metrics/orbit.h), over the
  // last half of the run but at most kTurns turns.
  std::vector<std::complex<double>> places{};
  int period = 0;  // in turns, see section_period
  // 1/s, largest Lyapunov exponent (engine/lyapunov.h); only in `up`
  std::optional<double> exponent{};
};

struct Bifurcation {
  static constexpr int kTurns = 64;
  std::vector<BranchPoint> up, down;  // in the order of their runs
  std::string not_continued;  // why every value starts at its own start; empty if they continue
};

// Why a study has no bifurcation diagram (several keys, words instead of numbers, MuJoCo); empty if
// it has one.
std::string no_bifurcation(const Study& study);

// progress: fraction done, in [0, 1]. Empty if interrupted.
std::optional<Bifurcation> bifurcation(const PointScenes& scenes,
                                       const std::atomic<bool>* interrupt,
                                       const std::function<void(double)>& progress);

}  // namespace rotorub::sweep
