// Restitution asked for and got, by contact model: MuJoCo's soft contact can be calibrated
// (mjcf/soft_contact.h), but not by its defaults.
#pragma once

#include <string>
#include <vector>

#include "compare/bench/passes.h"

namespace rotorub::bench {

struct RestitutionRow {
  double asked = 0.0;
  std::string engine;   // "mujoco-coulomb", "mujoco-default", ...
  double got = 0.0;     // speed after / before the first impact
  std::string failure;  // why there is no `got`; empty: there is
};

// A mass falls 0.5 mm on a fixed ring, head on, at a step of 10 us; asked 0, 0.1, ..., 1.
// "mujoco-default" is `coulomb` with the stiffness and the damping of MuJoCo's default solref
// (0.02 s, damping ratio 1), which knows nothing of what is asked.
std::vector<RestitutionRow> restitution_table(const Progress& progress,
                                              const std::atomic<bool>* interrupt);

}  // namespace rotorub::bench
