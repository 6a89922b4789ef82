// Largest Lyapunov exponent of a run: the rate at which two neighbouring runs separate. Both are
// run for a stretch of time T, and then brought back to their initial distance d_0 along the line
// between them (Benettin, Galgani, Giorgilli, Strelcyn 1980):
//
//   lambda = sum_k ln(d_k / d_0) / (stretches T).
//
// lambda > 0: chaos. About 0: a motion of several frequencies, or with an arbitrary phase on its
// orbit. Negative: a motion that attracts its neighbours.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "native_model/scene/forward.h"
#include "native_model/scene/run.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

struct LyapunovParameters {
  double stretch = 0.0;    // s, > 0, T; one turn is a good choice
  int settling = 20;       // stretches that align the line between the runs, not counted
  int stretches = 80;      // counted stretches
  double distance = 1e-8;  // d_0 relative to the smallest clearance (to 1 mm without a contact)
  std::optional<scene::Integrator> integrator{};  // default: the scene's
  const std::atomic<bool>* interrupt = nullptr;
};

struct Lyapunov {
  std::optional<double> exponent;  // 1/s
  std::string refused;             // reason if there is no exponent, without a full stop
  double stretch = 0.0;            // s, T as used
};

// Measures from the scene's start; for an attractor, start on it.
Lyapunov largest_lyapunov(const scene::Scene& scene, const LyapunovParameters& parameters);

// Measures the motion that a run of the scene has reached, starting where `run` ended. A stretch is
// one turn of the spin, rounded to whole steps at a fixed step; parameters.stretch is ignored.
Lyapunov lyapunov_after(const scene::Scene& scene, const Trajectory& run,
                        LyapunovParameters parameters = {});

}  // namespace rotorub
