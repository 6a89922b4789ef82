// MuJoCo's inverse dynamics including the plugin's loads and contact.
//
// mj_inverse calls mjcb_passive but not mjcb_control, in which the contact is solved. Without the
// plugin it therefore counts the contact's force as a force that the user would have to apply. Here
// qfrc_inverse belongs to a forward pass at the same state,
//   qfrc_inverse = M qacc + bias - passive - constraint   (nv values, N or N m),
// with the plugin's forces in passive and constraint. After mj_forward it therefore equals
// qfrc_applied + J' xfrc_applied + qfrc_actuator. In the preloaded library mj_inverse itself does
// so.
#pragma once

#include <mujoco/mujoco.h>

namespace rotorub::plugin {

// Like mj_inverseSkip, computed by `inverse` (MuJoCo's own). ctrl and all memory in userdata keep
// their values.
void inverse_with_contact(const mjModel* m, mjData* d, int skipstage, int skipsensor,
                          void (*inverse)(const mjModel*, mjData*, int, int) = mj_inverseSkip);

// Like mj_inverse, for programs that link the plugin.
inline void inverse(const mjModel* m, mjData* d) { inverse_with_contact(m, d, mjSTAGE_NONE, 0); }

}  // namespace rotorub::plugin
