// The plugin's memory in mjData.userdata, so that resetting and copying an mjData takes it along.
// mj_resetData sets all of it to 0, which means that nothing is known yet. Each struct below is
// laid over consecutive entries by one function. In order: ModelEntries; with a controller the
// velocities of the last two forward passes, nq each (control.cc), and the memory of a sampled one
// (native_model/control/control_loop.h); VerletEntries and ShadowEntries, if there are any; one
// ContactEntries for each further contact.
#pragma once

#include <mujoco/mujoco.h>

#include <type_traits>

#include "mjcf/names.h"
#include "plugin/model/config.h"

namespace rotorub::plugin {

// A rigid contact, or one of MuJoCo's soft contacts (contact/contact_memory.h).
struct ContactEntries {
  // In the last forward pass:
  mjtNum friction_force;  // N, on the rotor along e_t
  mjtNum mode;            // number of the Mode
  mjtNum normal_force;    // N; `rigid`: mean over the step that the pass is for
  // `rigid`:
  mjtNum time;    // s, of the pass to which the next three belong
  mjtNum before;  // m, between the centres if contact lasted over the previous step; else 0
  mjtNum now;     // m, between the centres if contact lasts over this step; else 0
  mjtNum
      status;  // Status of the contact laws, the bits of EscapeGuard and those of solver_watch.cc
  mjtNum impact;  // 1: the impulses of the step are those of an impact, with these rates
  mjtNum gap_rate_before, gap_rate_after, slip_before, slip_after;  // m/s
  mjtNum impact_time;                                               // s, in generated models
};

// A compliant contact, in the place of ContactEntries.
struct CompliantEntries {
  mjtNum friction_force, mode, normal_force;  // as in ContactEntries
  mjtNum damping;                             // s/m, the a of the present touch
  mjtNum gap;                                 // m, in the pass at `time`
  mjtNum touches;                             // contact/contact_memory.cc; 0: nothing is known
  mjtNum status;                              // as in ContactEntries
  mjtNum unused;
  mjtNum time;  // s, of the last pass
};

struct ModelEntries {
  mjtNum config_id;        // Config::id, a mark of this process; the motion does not depend on it
  mjtNum sample;           // sampled controller: index of the held sample, plus 1; 0: none yet
  mjtNum held_x, held_y;   // the held command: N, fixed frame, or the currents of the two axes, A;
                           // for native steps the mean about the instant
  mjtNum passive_fresh;    // between mjcb_passive and mjcb_control 1 + |time|, then kActed or
                           // kNotActed
  mjtNum history_length;   // times in the history: 0, 1, 2; 3: two, with an impact between them
  mjtNum earlier_time;     // s
  mjtNum latest_time;      // s
  ContactEntries contact;  // the first contact
};

// The leapfrog on the modal chain, from Config::verlet_data on (contact/verlet.h); velocities and
// two slots of memory follow.
struct VerletEntries {
  mjtNum begun;  // entries of a slot; 0: not begun
  mjtNum time;   // s, of the pass to which the first slot belongs
  mjtNum step;   // s
};

// The shadow, from ShadowConfig::data on (shadow.h); the memories of its ZeroOrderHold and of its
// stepper follow.
struct ShadowEntries {
  mjtNum begun;     // mark of the model with which it began (ShadowConfig); 0: not begun
  mjtNum edited;    // 1: the warning that the model was edited has been given
  mjtNum time;      // s, mjData.time that it has reached
  mjtNum step;      // s, its step
  mjtNum origin;    // s, from which its steps are counted
  mjtNum steps;     // taken since
  mjtNum status;    // number of the Status; it stands still unless kOk
  mjtNum normal;    // N, mean over the last step
  mjtNum friction;  // N, on the rotor along e_t
};

template <typename Entries>
inline constexpr int kEntries = sizeof(Entries) / sizeof(mjtNum);
static_assert(kEntries<ModelEntries> == mjcf_names::kUserDataSingle);
static_assert(kEntries<ContactEntries> == mjcf_names::kPairEntries);
static_assert(kEntries<CompliantEntries> <= kEntries<ContactEntries>);
static_assert(kEntries<VerletEntries> == mjcf_names::kVerletSingle);
static_assert(kEntries<ShadowEntries> == mjcf_names::kShadowSingle);

// The entries that begin at userdata[first].
template <typename Entries>
Entries& entries(mjData* d, int first) {
  static_assert(std::is_standard_layout_v<Entries> && sizeof(Entries) % sizeof(mjtNum) == 0);
  return *reinterpret_cast<Entries*>(d->userdata + first);
}
template <typename Entries>
const Entries& entries(const mjData* d, int first) {
  return entries<Entries>(const_cast<mjData*>(d), first);
}
inline ModelEntries& model_entries(const Config& config, mjData* d) {
  return entries<ModelEntries>(d, config.memory);
}
inline const ModelEntries& model_entries(const Config& config, const mjData* d) {
  return entries<ModelEntries>(d, config.memory);
}
inline ContactEntries& contact_entries(const ContactPair& pair, mjData* d) {
  return entries<ContactEntries>(d, pair.data);
}
inline const ContactEntries& contact_entries(const ContactPair& pair, const mjData* d) {
  return entries<ContactEntries>(d, pair.data);
}

// The entries that follow a struct.
template <typename Entries>
double* behind(Entries& e) {
  return reinterpret_cast<double*>(&e + 1);
}
template <typename Entries>
const double* behind(const Entries& e) {
  return reinterpret_cast<const double*>(&e + 1);
}

// ModelEntries::passive_fresh after mjcb_control: whether loads and contact were in the pass.
inline constexpr double kActed = 0.0, kNotActed = -1.0;

// Where the first contact's entries stand from Config::memory on; the entries of each further
// contact of a user's own model follow them.
inline constexpr int kFirstContact = kEntries<ModelEntries> - kEntries<ContactEntries>;

// A user's own model keeps a check of the block in ModelEntries::sample (block_is_ours).

// Our block in mjData.userdata of a user's own model, which others use too: it carries a check of
// what we wrote, so that entries that others write over are noticed.

// As we left it, or as a reset leaves it (all 0). True for generated models: theirs is nobody
// else's.
bool block_is_ours(const Config& config, const mjData* d);

// After our own changes.
void seal_block(const Config& config, mjData* d);

// mju_error that names the entries and how to move them.
void refuse_clash(const Config& config, const mjModel* m);

}  // namespace rotorub::plugin
