// The bifurcation diagram of a study of one key: where the rotor is once a turn, of what each value
// leads to, upwards and downwards. Each value begins where the one before it ended, so that a
// motion is followed as long as it stands: where up and down differ, there are two.
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
  std::string refused;     // why there is nothing here; empty: there is
  bool continued = false;  // begins where the one before it ended, not at the scene's own start
  // m, x + i y of the rotor at the contact whenever its mark passes +x (metrics/orbit.h), over the
  // last half of the run and no more than kTurns.
  std::vector<std::complex<double>> places{};
  int period = 0;                    // turns, section_period
  std::optional<double> exponent{};  // 1/s, the largest of Lyapunov (run/lyapunov.h); up alone
};

struct Bifurcation {
  static constexpr int kTurns = 64;
  std::vector<BranchPoint> up, down;  // in the order in which they ran
  std::string not_continued;          // why every value begins at its own start; empty: they do not
};

// Why a study has none: more than one key, words in the place of numbers, MuJoCo. Empty: it has
// one.
std::string no_bifurcation(const Study& study);

// progress: share done, in [0, 1]. Nothing: interrupted.
std::optional<Bifurcation> bifurcation(const PointScenes& scenes,
                                       const std::atomic<bool>* interrupt,
                                       const std::function<void(double)>& progress);

}  // namespace rotorub::sweep
