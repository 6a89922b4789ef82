// Our places in MuJoCo's global tables (places.h). Use Hooks (hooks.h).
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Puts our functions in front of those installed. Once; not from several threads.
void install_callbacks();

// Gives the places back. Where another library has put itself in front of us since, its function
// stays and ours, still called by it, only passes on.
void restore_callbacks();

bool callbacks_active();  // between the two

// Takes back every place that others have written over since. A few nanoseconds where none has. One
// of our functions that is still called brings the others back.
void keep_callbacks();

// As the places may have been written over without any of ours being called (all callbacks reset
// with the contact disabled), where MuJoCo's functions themselves can be had: register.cc.
bool callbacks_lost();

// Of the collision table: the place of the model's contact pair, with whose function the contacts
// of this pass may have been made. True where they must be made anew, once a thread. For `coulomb`
// and `cone`.
bool collision_was_lost(const Config& config, const mjModel* m);

// For mjcb_passive (mjcb_control), which has just seen that a pass went by without the other. Where
// who stands in front does not call us always, he is no longer let in front: true.
bool distrust_control();
bool distrust_passive();

}  // namespace rotorub::plugin
