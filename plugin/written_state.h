// States that a program writes between two steps. With `rigid` a contact that lasted over the
// previous step has no impact, because it touches already. If qpos and qvel were written since, the
// contact may be anywhere and begins afresh: for example, a rotor that is set down 1 nm before the
// wall with 0.3 m/s rebounds.
//
// A state that was not written is where its own velocity brought it. MuJoCo's steps are
// semi-implicit, so d - h d' is the place in the previous pass, up to h^2 / 2 times the
// acceleration of centres that move on circles (contact/relative_motion.h, turning). The distance
// |d - h d'| is compared with the one that was remembered while contact lasted. (The native step on
// the modal chain compares the whole state, contact/verlet.h.)
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/contact/relative_motion.h"
#include "plugin/model/config.h"

namespace rotorub::plugin {

// Call it before the contacts are solved. A written state ends every lasting contact.
void forget_written_contacts(const Config& config, const mjModel* m, mjData* d, PassMotion& motion);

}  // namespace rotorub::plugin
