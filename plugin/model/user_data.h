// The plugin's entries in mjData.userdata: all of its memory, so that resetting and copying an
// mjData takes it along. mj_resetData makes them 0. After the single entries, with a controller:
// the velocities of the last two forward passes, nq each (control.cc), and what a sampled
// one remembers (native_model/control/control_loop.h).
#pragma once

#include <mujoco/mujoco.h>

#include "mjcf/names.h"
#include "plugin/model/config.h"

namespace rotorub::plugin {

enum UserDataEntry : int {
  kConfigId,  // Config::id, a mark of this process; of no meaning to the motion
  kSample,    // sampled controller: index of the sample held, plus 1; 0: none yet
  kHeldX,     // command held: N, fixed frame, or the currents of the two axes, A; of native steps
              // the mean about the instant
  kHeldY,
  kPassiveFresh,   // between mjcb_passive and mjcb_control 1 + |time|, then kActed or kNotActed
  kHistoryLength,  // times in the history: 0, 1, 2; 3: two, with an impact between them
  kEarlierTime,    // s, of the one before
  kLatestTime,     // s, of the latest
  // Of each rotor in its ring:
  kFrictionForce,  // N, on the rotor along e_t, of the forward pass done last
  kMode,           // number of the Mode of that pass
  // and of `rigid` (contact/contact_memory.h):
  kNormalForce,    // N, mean over the step that the pass is for
  kContactTime,    // s, of the pass that the next three are of
  kContactBefore,  // m, between the centres of a contact that lasted over the step before; 0: none
  kContactNow,     // m, of one that lasts over this one
  kContactStatus,  // Status of the contact laws, EscapeGuard's bits, and those of solver_watch.cc
  kImpact,         // 1: the step's impulses are an impact's, with
  kGapRateBefore,  // m/s
  kGapRateAfter,
  kSlipBefore,
  kSlipAfter,
  kImpactTime,  // s, of generated models
  kUserDataSingle
};
static_assert(kUserDataSingle == mjcf_names::kUserDataSingle);

// A compliant contact uses entries that only `rigid` needs otherwise: its state (0 after a reset;
// contact/contact_memory.cc), the a of its touch (s/m), and the time (s) and gap (m) of the pass
// that these belong to.
inline constexpr int kTouches = kContactNow, kTouchDamping = kContactTime,
                     kTouchTime = kGapRateBefore, kTouchGap = kContactBefore;

// Whether loads and contact were in the pass.
inline constexpr double kActed = 0.0, kNotActed = -1.0;

// A user's own model has its block at Config::memory, with a check in the place of kSample
// (block_is_ours). A further pair has kPairEntries more behind it: entry e of pair i stands at
// ContactPair::data + e = memory + i kPairEntries + e, e from kFrictionForce on.
inline constexpr int kBlockCheck = kSample;
inline constexpr int kPairEntries = kUserDataSingle - kFrictionForce;
static_assert(kPairEntries == mjcf_names::kPairEntries);

// Of the step of `rigid` on the modal chain, from Config::verlet_data on (contact/verlet.h); behind
// them velocities and two slots of memory.
enum VerletEntry : int {
  kVerletBegun,  // entries of a slot; 0: not begun
  kVerletTime,   // s, of the pass that the first slot is of
  kVerletStep,   // s
  kVerletSingle
};
static_assert(kVerletSingle == mjcf_names::kVerletSingle);

// The shadow's, from Config::shadow.data on (shadow.h); behind them the memories of its
// controller's hold and of its stepper.
enum ShadowEntry : int {
  kShadowBegun,     // mark of the model that it began with (ShadowConfig); 0: not begun
  kShadowEdited,    // 1: it was said that the model was edited
  kShadowTime,      // s, mjData.time that it has come to
  kShadowStep,      // s, its step
  kShadowOrigin,    // s, where its steps are counted from
  kShadowSteps,     // taken since
  kShadowStatus,    // number of the Status; it stands still unless kOk
  kShadowNormal,    // N, mean over the last step
  kShadowFriction,  // N, on the rotor along e_t
  kShadowSingle     // behind them the memory of its ZeroOrderHold
};
static_assert(kShadowSingle == mjcf_names::kShadowSingle);

// Our block in mjData.userdata of a user's own model, which others use too: it carries a check of
// what we wrote, so that entries that others write over are noticed.

// As we left it, or as a reset leaves it (all 0). True for generated models: theirs is nobody
// else's.
bool block_is_ours(const Config& config, const mjData* d);

// After our own changes.
void seal_block(const Config& config, const mjData* d);

// mju_error that names the entries and how to move them.
void refuse_clash(const Config& config, const mjModel* m);

}  // namespace rotorub::plugin
