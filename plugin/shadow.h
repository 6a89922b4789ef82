// The shadow: the native model, run alongside by the stepper `verlet`, one step for each MuJoCo
// step. With `rigid` on a modal chain MuJoCo takes the same steps, so their agreement is not
// evidence. The shadow starts from MuJoCo's state and then receives only the commands from MuJoCo:
// a controller of the scene closes its own loop; without one, the shadow receives the force that
// MuJoCo's actuators exerted on the ring over the step. Its results go to user sensors and ghost
// bodies; MuJoCo's motion never depends on it.
//
// All of its memory is in mjData.userdata (user_data.h). MuJoCo does not report the end of a step,
// so the shadow recognises it by the first mjcb_passive at a later time.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Call it first in mjcb_passive, while mjData still contains the forces of the last step. With t
// the time that the shadow has reached and h the step,
//   d->time = t          nothing (a repeated pass; before the first step: starts from this state)
//   t < d->time < t + h  nothing (RK4's passes within its step)
//   d->time = t + h      one step
//   anything else        starts afresh from MuJoCo's state
// to within 1e-6 h. An mjModel that was edited since (model_parameters.h) is another model: the
// shadow starts afresh, with one mju_warning in a run. A step that fails stops the shadow with one
// mju_warning.
void advance_shadow(const Config& config, const mjModel* m, mjData* d);

// The shadow's state for display: the coordinates of its model, then as many velocities, which are
// half a step older.
const double* shadow_state(const Config& config, const mjData* d);

// Fills the addresses of sensors and ghosts; shadow.model must be filled. Throws ConfigError if the
// step is too long for the shadow.
void map_shadow(const mjModel* m, ShadowConfig& shadow);

// FNV-1a hash of the numbers that an edit of mjModel may change, as a whole number > 0 that a
// double represents exactly.
double mark_of(const Model& model);

}  // namespace rotorub::plugin
