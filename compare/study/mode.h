// How the two sides of a comparison are coupled.
#pragma once

#include <string>

namespace rotorub {

enum class CompareMode {
  kLockstep,  // each side closes its own loop
  kReplay,    // the native side is driven by the commands that MuJoCo's actuators were given: what
              // differs is the contact, and not the closed loop
  kResync     // at every onset of contact the native side restarts from MuJoCo's state and predicts
              // that contact: says something even of trajectories that are chaotic
};

const char* to_string(CompareMode mode);  // "lockstep", "replay", "resync"
// Of one of these names; asserts that it is one.
CompareMode compare_mode_of(const std::string& name);

}  // namespace rotorub
