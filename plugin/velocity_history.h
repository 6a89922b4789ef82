// Velocities at the time of the positions. MuJoCo's Euler step is semi-implicit,
//   v_k = v_{k-1} + h a,   q_k = q_{k-1} + h v_k,
// so its v_k is the velocity of half a step before t_k. A controller that weighs the gap rate
// against a boundary layer sees the difference: in a whirl it is h/2 v_t^2 / delta. It is given
//   v(t_k) = v_k + (v_k - v_{k-1}) / 2.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"
#include "plugin/coordinates.h"

namespace rotorub::plugin {

// Notes the state's velocities for its time and writes v(t) (nq values) to `now`. Repeated calls at
// one time give the same; without a step of the model's length before it, and for RK4, whose
// velocities are not late, v(t) is the state's.
void velocity_at_time(const Config& config, const mjModel* m, mjData* d, const Coordinates& state,
                      double* now);

}  // namespace rotorub::plugin
