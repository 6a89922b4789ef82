// The shadow: the native model, run alongside by the stepping of `verlet`, one step a MuJoCo step.
// With `rigid` on a modal chain MuJoCo takes the same steps, so that their agreement is no
// evidence. It starts from MuJoCo's state and then knows nothing of MuJoCo but the commands: a
// controller of the scene closes its own loop; without one, the shadow is given the force that
// MuJoCo's actuators exerted on the ring over the step. What it has goes to user sensors and ghost
// bodies; MuJoCo's motion never depends on it.
//
// All of its memory is in mjData.userdata (user_data.h). MuJoCo says nowhere that a step is done:
// the first mjcb_passive at a later time is the sign.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// To be called first in mjcb_passive: mjData still holds the forces of the step just done. With t
// the time that the shadow has come to and h the step,
//   d->time = t          nothing (a repeated pass; before the first step: starts from this state)
//   t < d->time < t + h  nothing (RK4's passes within its step)
//   d->time = t + h      one step
//   anything else        starts anew from MuJoCo's state
// to within 1e-6 h. A mjModel that was edited since (model_parameters.h) is another model: the
// shadow starts anew, and once in a run an mju_warning says so. A step that fails stops the shadow
// with one mju_warning.
void advance_shadow(const Config& config, const mjModel* m, mjData* d);

// Where it is, for those who look on: coordinates of the shadow's model, then as many velocities,
// which are those of half a step before.
const double* shadow_state(const Config& config, const mjData* d);

// Fills the addresses of sensors and ghosts; `model` is the scene's. Throws ConfigError for a step
// that it cannot take.
void map_shadow(const mjModel* m, ShadowConfig& shadow);

// FNV-1a of the numbers that an edit of mjModel changes, as a whole number > 0 that a double holds.
double mark_of(const Model& model);

}  // namespace rotorub::plugin
