// MuJoCo's options and flags: which of them take a contact away, and which are refused.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// False under mjDSBL_CONTACT or mjDSBL_CONSTRAINT: then `rigid` has none either.
inline bool contact_enabled(const mjModel* m) {
  return (m->opt.disableflags & (mjDSBL_CONTACT | mjDSBL_CONSTRAINT)) == 0;
}

// Null, or the mju_error for options under which no pass is right: rotor or ring may be put to
// sleep, from which the plugin's loads do not wake it, or MuJoCo's solver takes <option>'s numbers
// for those of a contact that it solves for us.
const char* refused_options(const Config& config, const mjModel* m);
// Where the contact acts: null, or that impulses are once a step, and RK4's four stages are not.
const char* refused_integrator(const Config& config, const mjModel* m);
// Of newer MuJoCo: null, or that neither mjcb_passive nor mjcb_control is called.
const char* refused_silence(const mjModel* m);

}  // namespace rotorub::plugin
