// The plugin's memory in mjData.userdata, so that resetting and copying an mjData takes it along.
// mj_resetData sets all of it to 0, which means that nothing is known yet. Each struct below is
// laid over consecutive entries by one function. The order is:
// - ModelEntries;
// - with a controller, the velocities of the last two forward passes, nq each (control.cc), and the
//   memory of a sampled controller (native_model/control/control_loop.h);
// - VerletEntries and ShadowEntries, if the model needs them;
// - one ContactEntries for each further contact.
#pragma once

#include <mujoco/mujoco.h>

#include <cmath>
#include <limits>
#include <type_traits>

#include "mjcf/names.h"
#include "plugin/model/config.h"

namespace rotorub::plugin {

// The memory of a rigid contact or of one of MuJoCo's soft contacts (contact/contact_memory.h).
struct ContactEntries {
  // In the last forward pass:
  mjtNum friction_force;  // N, on the rotor along e_t
  mjtNum mode;            // the ContactMode as a number
  mjtNum normal_force;    // N; for `rigid` the mean over the step that begins with the pass
  // The rest is for `rigid` only, except `status`:
  mjtNum time;    // s, of the pass to which `before`, `now` and `status` belong
  mjtNum before;  // m, distance of the centres if contact lasted over the previous step; else 0
  mjtNum now;     // m, distance of the centres if contact lasts over this step; else 0
  mjtNum status;  // the Status of the contact laws with its flags (contact/contact_status.h)
  mjtNum impact;  // 1: the impulses of the step belong to an impact, with these rates
  mjtNum gap_rate_before, gap_rate_after, slip_before, slip_after;  // m/s
  mjtNum impact_time;                                               // s; only in generated models
};

// The memory of a compliant contact, in place of ContactEntries.
struct CompliantEntries {
  mjtNum friction_force, mode, normal_force;  // as in ContactEntries
  mjtNum damping;                             // s/m, the factor a of the present touch
  mjtNum gap;                                 // m, gap in the pass at `time`
  mjtNum touches;  // state of the contact (contact/contact_memory.cc); 0: unknown
  mjtNum status;   // as in ContactEntries
  mjtNum unused;
  mjtNum time;  // s, of the last pass
};

struct ModelEntries {
  mjtNum config_id;  // Config::id, unique in this process; the motion does not depend on it
  // A scene's sampled controller: index of the held sample, plus 1; 0: none yet. In a user's own
  // model: the checksum of the block.
  mjtNum sample;
  // The held command: N in the fixed frame, or the currents of the two axes, A. With native steps
  // it is the mean command about the instant.
  mjtNum held_x, held_y;
  // 1 + |time| between mjcb_passive and mjcb_control, then kActed or kNotActed.
  mjtNum passive_fresh;
  // Number of times in the history: 0, 1 or 2; 3: two times with an impact between them.
  mjtNum history_length;
  mjtNum earlier_time;     // s
  mjtNum latest_time;      // s
  ContactEntries contact;  // the first contact
};

// The memory of the leapfrog on the modal chain, from Config::verlet_data on (contact/verlet.h).
// Velocities and two slots of memory follow.
struct VerletEntries {
  mjtNum begun;  // number of entries of a slot; 0: not begun
  mjtNum time;   // s, of the pass to which the first slot belongs
  mjtNum step;   // s
};

// The memory of the shadow, from ShadowConfig::userdata on (shadow.h). The memories of its
// ZeroOrderHold and of its stepper follow.
struct ShadowEntries {
  mjtNum begun;     // ShadowConfig::mark of the model with which it began; 0: not begun
  mjtNum edited;    // 1: the user has been warned that the model was edited
  mjtNum time;      // s, the value of mjData.time that it has reached
  mjtNum step;      // s
  mjtNum origin;    // s, time from which its steps are counted
  mjtNum steps;     // number of steps taken since
  mjtNum status;    // the Status as a number; the shadow has stopped unless it is kOk
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
  return entries<ContactEntries>(d, pair.userdata);
}
inline const ContactEntries& contact_entries(const ContactPair& pair, const mjData* d) {
  return entries<ContactEntries>(d, pair.userdata);
}

// s, difference of two times up to round-off: of the step h, and of MuJoCo's sum of the steps until
// `time` (s).
inline double time_tolerance(double h, double time) {
  return 1e-6 * h + 4.0 * std::numeric_limits<double>::epsilon() * std::abs(time);
}
// True if the time that passed until `time` is one step. All in s.
inline bool is_next_step(double passed, double h, double time) {
  return std::abs(passed - h) <= time_tolerance(h, time);
}

// The memory just behind a struct.
template <typename Entries>
double* behind(Entries& e) {
  return reinterpret_cast<double*>(&e + 1);
}
template <typename Entries>
const double* behind(const Entries& e) {
  return reinterpret_cast<const double*>(&e + 1);
}

// Values of ModelEntries::passive_fresh after mjcb_control: whether loads and contact were included
// in the pass.
inline constexpr double kActed = 0.0, kNotActed = -1.0;

// Index of the first contact's entries, counted from Config::memory. In a user's own model the
// entries of the further contacts follow.
inline constexpr int kFirstContact = kEntries<ModelEntries> - kEntries<ContactEntries>;

// Other programs may use mjData.userdata of a user's own model too. The plugin's block therefore
// carries a checksum in ModelEntries::sample, so that the plugin notices if others write over its
// entries.

// True if the block is as the plugin left it, or all 0 as after a reset. Always true for generated
// models, because nobody else uses their entries.
bool block_is_ours(const Config& config, const mjData* d);

// Updates the checksum after the plugin's own changes.
void seal_block(const Config& config, mjData* d);

// Raises a mju_error that names the entries and says how to move them.
void refuse_clash(const Config& config, const mjModel* m);

}  // namespace rotorub::plugin
