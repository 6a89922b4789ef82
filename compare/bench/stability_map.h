// Where MuJoCo's soft contact can be trusted: how runs end over step, stiffness and friction.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "compare/bench/point.h"
#include "compare/bench/progress.h"
#include "compare/bench/setting.h"

namespace rotorub::bench {

struct StabilityCell {
  std::string engine;      // "mujoco-coulomb"
  double friction = 0.0;   // mu
  double step = 0.0;       // s
  double stiffness = 0.0;  // 1/s^2, direct solref; 0: none (rigid)
  Judgement judgement;
};

struct StabilityMap {
  std::vector<std::string> engines;
  std::vector<double> steps, stiffnesses, frictions;  // as the cells run, the last the fastest
  std::vector<StabilityCell> cells;
};

// Frictions: half, one and two times the scene's (none: 0 alone). Every cell against `event` at its
// own friction.
StabilityMap stability_map(const SceneReader& reader, const scene::Scene& scene,
                           const Progress& progress, const std::atomic<bool>* interrupt);

}  // namespace rotorub::bench
