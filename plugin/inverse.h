// MuJoCo's inverse dynamics with the plugin's loads and contact in it.
//
// mj_inverse calls mjcb_passive and not mjcb_control, in which the contact is solved: alone it
// takes the contact's force for one that the user would have to apply. Here qfrc_inverse is that of
// a forward pass at the same state:
//   qfrc_inverse = M qacc + bias - passive - constraint   (nv values, N or N m)
// with the plugin's forces in passive and constraint, so that after mj_forward it is qfrc_applied +
// J' xfrc_applied + qfrc_actuator. The preloaded library does so in mj_inverse itself.
#pragma once

#include <mujoco/mujoco.h>

namespace rotorub::plugin {

// As mj_inverseSkip, by `inverse` (MuJoCo's own). ctrl and all memory in userdata stay as they
// were.
void inverse_with_contact(const mjModel* m, mjData* d, int skipstage, int skipsensor,
                          void (*inverse)(const mjModel*, mjData*, int, int) = mj_inverseSkip);

// As mj_inverse, for programs that link the plugin.
inline void inverse(const mjModel* m, mjData* d) { inverse_with_contact(m, d, mjSTAGE_NONE, 0); }

}  // namespace rotorub::plugin
