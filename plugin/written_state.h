// States that a program writes between two steps. Under `rigid` a contact that lasted over the step
// before has no impact, because it touches already. If qpos and qvel were written since, the
// contact may be anywhere and begins anew: a rotor that is set down 1 nm before the wall with
// 0.3 m/s rebounds.
//
// A state that was not written is where its own velocity brought it: MuJoCo's steps are
// semi-implicit, so that d - h d' is the place of the pass before, up to h^2 / 2 times the
// acceleration of centres that go in circles (contact/contact_space.h, turning_of). The distance
// |d - h d'| is compared with the one that was remembered while contact lasted. (The native step on
// the modal chain compares the whole state, contact/verlet.h.)
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Before the contacts are solved: a written state ends every lasting contact.
void forget_written_contacts(const Config& config, const mjModel* m, mjData* d);

// After the contacts are solved: remembers the place of each lasting contact.
void remember_places(const Config& config, const mjModel* m, mjData* d);

}  // namespace rotorub::plugin
