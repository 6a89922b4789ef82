// What the modal chain's joints do not have by themselves, as passive forces: gyroscopic and
// circulatory terms, bearing dampers, unbalance, excitation, drive, gravity on the modes.
//
// MuJoCo's Euler step solves (M + h D) dv = h f, M and D diagonal here. Explicit gyroscopic forces
// would feed h g^2/2; instead the force handed over is that which gives the velocity change of
//   (M(phi) + h D) dv = h (f - Omega G (v + dv/2)),
// the gyroscopic part at the midpoint and the spin-bending coupling of unbalance in M(phi). The
// contact's own share of dv is not known yet; it is left explicit in the gyroscopic term.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"
#include "plugin/coordinates.h"

namespace rotorub::plugin {

// Adds to d->qfrc_passive, which holds the joints' springs and dampers.
void add_passive_force(const Config& config, const mjModel* m, mjData* d, const Coordinates& state);

// The diagonal of M + h D (nq values) that the model's integrator solves with; M alone for RK4.
void step_mass(const Config& config, const mjModel* m, double* diagonal);

}  // namespace rotorub::plugin
