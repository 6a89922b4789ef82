// Contact model `rigid` of generated models on the modal chain: the native step `verlet`
// (native_model/stepping/verlet.h) in the place of MuJoCo's. MuJoCo's Euler step,
//   v_{k+1/2} = v_{k-1/2} + H^-1 h f,   q_{k+1} = q_k + h v_{k+1/2},   H = M + h D,
// is leapfrog once its velocity is read as that of the middle of the step. What f must be so that
// v_{k+1/2} is that of `verlet` (damping at the middle, located impacts, what they leave over) is
// handed to MuJoCo as a passive force. Forces that others put on the chain (passive, applied,
// actuators, joints edited in the model) act in it too.
//
// All memory is in mjData.userdata: one slot before the step of the present time, one after it, so
// that repeated passes at one time give the same. A state that was set from outside, or a time that
// is not the next one, starts anew: its velocities are those of its own time.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"
#include "plugin/model/generated_rotor.h"

namespace rotorub::plugin {

// Entries of userdata for a model (plugin/model/user_data.h), without coils.
int verlet_data_size(const Model& model);
// Where the memory of the sampled controller stands (Config::loop_data).
int verlet_loop_data(const Config& config);

// Writes ctrl of the scene's controller, adds to d->qfrc_passive and sets the userdata entries of
// the contact. Called in mjcb_control. mju_error for RK4.
void apply_verlet(const Config& config, const mjModel* m, mjData* d, const Coordinates& state);

// Whether the step that comes is the first from a state that was set: half a kick.
bool begins_anew(const Config& config, const mjModel* m, const mjData* d);

// J, of a native step on the coordinates: of the contacts, of their impacts alone, and of all
// forces but springs and contact.
struct StepWorks {
  double contact = 0.0, impact = 0.0, external = 0.0;
};
// The steps that this thread takes from here on tell their works there; null: nobody asks.
void tell_works(StepWorks* to);

// The velocities of the time of the forward pass done last (nq values), before an impact of its
// step.
const double* velocities_of_pass(const Config& config, const mjData* d);

}  // namespace rotorub::plugin
