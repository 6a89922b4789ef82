// The functions that MuJoCo calls, and their places in its global tables. Use Hooks (hooks.h).
#pragma once

namespace rotorub::plugin {

// Puts our functions in front of those installed. Once; not from several threads.
void install_callbacks();

// Gives the places back. Where another library has put itself in front of us since, its function
// stays and ours, still called by it, only passes on.
void restore_callbacks();

}  // namespace rotorub::plugin
