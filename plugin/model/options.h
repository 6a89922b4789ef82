// MuJoCo's options and flags: which of them disable a contact, and which are refused.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// False with mjDSBL_CONTACT or mjDSBL_CONSTRAINT. Then the contacts of `rigid` are disabled too.
inline bool contact_enabled(const mjModel* m) {
  return (m->opt.disableflags & (mjDSBL_CONTACT | mjDSBL_CONSTRAINT)) == 0;
}

// The text of a mju_error for options with which no pass is right; null if there is none. Such
// options let rotor or ring fall asleep, from which the plugin's loads do not wake them, or let
// MuJoCo's solver use the numbers of <option> for a contact that it solves for the plugin, or are
// attributes that the plugin does not support (later_attributes.h).
const char* refused_options(const Config& config, const mjModel* m);
// The text of a mju_error for RK4, where impulses or samples once a step do not fit four stages;
// null if the integrator is accepted.
const char* refused_integrator(const Config& config, const mjModel* m);
// The text of a mju_error for flags of newer MuJoCo with which neither mjcb_passive nor
// mjcb_control is called; null if there is none.
const char* refused_silence(const mjModel* m);

}  // namespace rotorub::plugin
