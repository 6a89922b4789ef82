// The plugin's entries in mjData.userdata: all of its memory, so that resetting and copying an
// mjData takes it along. mj_resetData makes them 0. After the single entries, with a controller:
// the velocities of the last two forward passes, nq each (velocity_history.h).
#pragma once

#include "mjcf/names.h"

namespace rotorub::plugin {

enum UserDataEntry : int {
  kConfigId,    // Config::id, a mark of this process; of no meaning to the motion
  kTouched,     // 1: the contact has been touched
  kFirstTouch,  // s, valid when touched
  kSample,      // sampled controller: index of the sample held, plus 1; 0: none yet
  kHeldX,       // N, command held
  kHeldY,
  kFrictionForce,  // N, on the rotor along e_t, of the forward pass done last (`coulomb`)
  kMode,           // number of the Mode of that pass
  kPassiveFresh,   // 1 between mjcb_passive and mjcb_control
  kHistoryLength,  // forward passes in the history: 0, 1, 2
  kEarlierTime,    // s, of the one before
  kLatestTime,     // s, of the latest
  kUserDataSingle
};
static_assert(kUserDataSingle == mjcf_names::kUserDataSingle);

}  // namespace rotorub::plugin
