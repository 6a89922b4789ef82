// How far MuJoCo's soft contact can be trusted: its restitution, and how its runs end.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "compare/bench/engines.h"
#include "compare/bench/point.h"

namespace rotorub::bench {

// Requested and obtained restitution of a contact model. MuJoCo's soft contact can be calibrated
// (mjcf/soft_contact.h), but its defaults do not match a restitution.
struct RestitutionRow {
  double asked = 0.0;
  std::string engine;   // "mujoco-coulomb"
  std::string setting;  // "K 1e6", "default solref"; empty if there is only one
  double got = 0.0;     // speed after / speed before the first impact
  std::string failure;  // why `got` is missing; empty if it is set
};

// 1/s^2: a bounce takes 300 steps of 10 us. With the stiffest contact that the step allows, it
// takes 16 steps, and the restitution is less accurate.
inline constexpr double kCalibratedStiffness = 1e6;

// A mass hits a fixed ring head-on at 0.5 m/s with a step of 10 us, for restitutions 0, 0.1, ...,
// 1. "default solref" is `coulomb` with stiffness and damping of MuJoCo's default (0.02 s, damping
// ratio 1), independent of the requested restitution.
std::vector<RestitutionRow> restitution_table(const Progress& progress,
                                              const std::atomic<bool>* interrupt);

// How runs end, depending on step, stiffness and friction.
struct StabilityCell {
  std::string engine;      // "mujoco-coulomb"
  double friction = 0.0;   // mu
  double step = 0.0;       // s
  double stiffness = 0.0;  // 1/s^2, direct solref; 0 for rigid, which has none
  Judgement judgement;
};

struct StabilityMap {
  std::vector<std::string> engines;
  // In the order of the cells, the last varies fastest.
  std::vector<double> steps, stiffnesses, frictions;
  std::vector<StabilityCell> cells;
};

// Frictions, each of all contacts: half, one and two times the largest of the scene's contacts, or
// only 0 if that is 0. Every cell is compared with `event` at the same friction.
StabilityMap stability_map(const SceneReader& reader, const scene::Scene& scene,
                           const Progress& progress, const std::atomic<bool>* interrupt);

}  // namespace rotorub::bench
