// The third error of a comparison, beside those of contact model and step: that of the bending
// modes kept, which both sides share. The native model runs with `event` over a rising ladder of
// modes.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "compare/model_error/limit.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// n, and three rungs above it, a third of n (at least 2) apart: up to twice as many. The cost of a
// rung grows with about the cube of its modes: a ladder takes some 20 runs of the scene's own.
std::vector<int> mode_ladder(int modes);

struct ModelErrorParameters {
  double tolerance = 0.01;               // share: on the judged figures
  std::vector<double> spread;            // of twins, as figures(); empty: 0
  double step = 0.0;                     // s, that forces are averaged over; 0: the scene's
  std::function<void(double)> progress;  // share done; may be empty
  const std::atomic<bool>* interrupt = nullptr;
};

struct ModelError {
  std::vector<int> modes;            // of the rungs, ascending, the scene's first
  std::vector<FigureLimit> figures;  // the judged ones; empty where there is a reason
  std::string reason;                // why nothing is known; empty: it is
};

// The rungs run on all processors; the result does not depend on how many there are.
ModelError model_error(const scene::Scene& scene, const ModelErrorParameters& parameters);

// "modes kept: 12, 16, 20, 24" and a line a figure, for the terminal; `lead` before each line.
std::string model_error_table(const ModelError& error, const std::string& lead);

}  // namespace rotorub
