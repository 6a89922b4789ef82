// Contact model `rigid` of generated models on the modal chain: the native step `verlet`
// (native_model/stepping/verlet.h) in place of MuJoCo's. MuJoCo's Euler step,
//   v_{k+1/2} = v_{k-1/2} + H^-1 h f,   q_{k+1} = q_k + h v_{k+1/2},   H = M + h D,
// is a leapfrog if its velocity is read as the velocity of the middle of the step. The plugin hands
// MuJoCo a passive force with which v_{k+1/2} equals the velocity of `verlet` (damping at the
// middle of the step, located impacts, the remainder of the last impact). Forces that others put on
// the chain (passive, applied, actuators, joints edited in the model) act in the native step too.
//
// All memory is in mjData.userdata: one slot before the step of the present time and one after it,
// so that repeated passes at one time give the same result. If the state was set from outside, or
// the time is not the next one, the step starts afresh and takes the velocities as simultaneous
// with the positions.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"
#include "plugin/model/generated_rotor.h"

namespace rotorub::plugin {

// Writes the command of the scene's controller to ctrl, adds to d->qfrc_passive and sets the
// userdata entries of the contacts. Called by apply_command_and_contacts() (passes.cc). RK4 must
// have been refused (model/options.h).
void apply_verlet(const Config& config, const mjModel* m, mjData* d, const Coordinates& state);

// Works of a native step on the coordinates, J: of all contacts, of their impacts alone, and of all
// forces except springs and contacts.
struct StepWorks {
  double contact = 0.0, impact = 0.0, external = 0.0;
};
// From now on each native step of this thread writes its works to `to`. If `to` is null, the works
// are not computed.
void record_works(StepWorks* to);

// --- The memory in userdata (verlet_memory.cc) ---

// The index of the memory of the sampled controller (Config::loop_data).
int verlet_loop_data(const Config& config);

// True if the next step is the first from a state that was set, and so is half a kick.
bool begins_anew(const Config& config, const mjModel* m, const mjData* d);

// The velocities at the time of the last forward pass (nq values), before an impact in its step.
const double* velocities_of_pass(const Config& config, const mjData* d);

}  // namespace rotorub::plugin
