// How far MuJoCo's soft contact can be trusted: the restitution that it gives, and how runs end.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "compare/bench/engines.h"
#include "compare/bench/point.h"

namespace rotorub::bench {

// Restitution asked for and got, by contact model: MuJoCo's soft contact can be calibrated
// (mjcf/soft_contact.h), but not by its defaults.
struct RestitutionRow {
  double asked = 0.0;
  std::string engine;   // "mujoco-coulomb"
  std::string setting;  // "K 1e6", "default solref"; empty: there is but one
  double got = 0.0;     // speed after / before the first impact
  std::string failure;  // why there is no `got`; empty: there is
};

// 1/s^2: a bounce takes 300 steps of 10 us. One as stiff as the step allows takes 16, and meets its
// restitution only so well.
inline constexpr double kCalibratedStiffness = 1e6;

// A mass hits a fixed ring head on at 0.5 m/s, at a step of 10 us; asked 0, 0.1, ..., 1. "default
// solref" is `coulomb` with the stiffness and the damping of MuJoCo's default (0.02 s, damping
// ratio 1), which knows nothing of what is asked.
std::vector<RestitutionRow> restitution_table(const Progress& progress,
                                              const std::atomic<bool>* interrupt);

// How runs end over step, stiffness and friction.
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
