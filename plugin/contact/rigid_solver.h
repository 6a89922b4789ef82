// Contact model `rigid` over one step of MuJoCo, for contacts that act on the same bodies (two
// rings on one shaft): they are one problem (native_model/contact/coupled_law.h), which has a
// closed form for one contact.
//
// A step has two parts. First come the lasting contacts, (12)-(13), together over the step. Then
// come the impacts, in no time, with the velocities that the first part leaves: (15)-(19) for all
// closed contacts at once, because a lasting contact takes part in an impact elsewhere on its
// shaft. Beside constraints the forces of the step may then close a gap again
// (constrained_law.h). If the impulses drive the rotor into a further ring, that contact is closed
// too and the step is solved again.
#pragma once

#include <mujoco/mujoco.h>

#include <span>

#include "plugin/contact/rigid_contacts.h"

namespace rotorub::plugin {

// Fills the results and adds the impulses to `to` as forces over the step. Call it after
// update_smooth_force.
void solve_rigid_contacts(const mjModel* m, mjData* d, std::span<RigidContact* const> contacts,
                          mjtNum* to);

}  // namespace rotorub::plugin
