// The plugin's slots in MuJoCo's global tables (callback_slot.h). Programs use Hooks (hooks.h).
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Puts the plugin's functions in front of those that are installed. Call it once, and not from
// several threads.
void install_callbacks();

// Restores the slots. If another library has put its function in front since, that function stays,
// and the plugin's functions, which it still calls, only call the previous ones.
void restore_callbacks();

bool callbacks_active();  // true between install_callbacks() and restore_callbacks()

// Takes back every callback that others have overwritten. All of the plugin's functions call it, so
// one function that is still called restores the others. It costs a few nanoseconds if none was
// overwritten.
void keep_callbacks();

// True if one of the callbacks was overwritten (not the collision table). Where MuJoCo's own
// functions can be intercepted (register.cc), this also finds the case in which none of the
// plugin's functions is called any more (all callbacks reset, with contacts disabled).
bool callbacks_lost();

// Takes back the slots of the model's contact pairs in the collision table. Returns true, once in
// each thread, if another function may have made the contacts of this pass, so that they must be
// made again. For the soft contact models.
bool collision_was_lost(const Config& config, const mjModel* m);

// For mjcb_passive (mjcb_control), when it finds that a pass had no mjcb_control (mjcb_passive).
// True if the function in front used to call the plugin and did not call it this time; that
// function is then never let in front again.
bool distrust_control();
bool distrust_passive();

}  // namespace rotorub::plugin
