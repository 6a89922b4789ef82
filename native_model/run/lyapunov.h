// The largest Lyapunov exponent of a run: how fast two runs that start beside each other part. They
// are run for a stretch of time, and brought back to their first distance d_0 along the line
// between them (Benettin, Galgani, Giorgilli, Strelcyn 1980):
//
//   lambda = sum_k ln(d_k / d_0) / (stretches T).
//
// Above 0: chaos; about 0: a motion of several frequencies, or one that may be anywhere on its
// orbit; below: a motion that others come to.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "native_model/scene/forward.h"
#include "native_model/scene/run.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

struct LyapunovParameters {
  double stretch = 0.0;    // s, > 0, T; that of a turn is a good one
  int settling = 20;       // stretches that turn the line between the runs, and are not counted
  int stretches = 80;      // that are
  double distance = 1e-8;  // d_0 over the clearance (over 1 mm without a contact)
  std::optional<scene::Integrator> integrator{};  // default: the scene's
  const std::atomic<bool>* interrupt = nullptr;
};

struct Lyapunov {
  std::optional<double> exponent;  // 1/s
  std::string refused;             // why there is none, without a full stop
  double stretch = 0.0;            // s, that was taken
};

// From the scene's start on: of an attractor, a start on it.
Lyapunov largest_lyapunov(const scene::Scene& scene, const LyapunovParameters& parameters);

// Of what a run has come to: from where `run`, of the scene, ended. A stretch is a turn, of a fixed
// step the whole steps nearest to it; parameters.stretch is not read.
Lyapunov lyapunov_after(const scene::Scene& scene, const Trajectory& run,
                        LyapunovParameters parameters = {});

}  // namespace rotorub
