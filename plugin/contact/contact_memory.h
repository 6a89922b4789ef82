// The memory of a contact in mjData.userdata and in its thread, and its forces after a forward
// pass.
#pragma once

#include <mujoco/mujoco.h>

#include <cmath>
#include <limits>

#include "native_model/contact/kinematics.h"
#include "native_model/trajectory/trajectory.h"
#include "plugin/contact/rigid_step.h"
#include "plugin/model/config.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_versions.h"
#include "plugin/model/user_data.h"

namespace rotorub::plugin {

// With `rigid` a rotor that was within its clearance does not penetrate the wall by more than
// kDeep. If one does, the step is too long for its motion, or something that the contact does not
// see moves rotor or ring. The user is warned once, and `rotorub_active` is 0 meanwhile. The guard
// keeps its bits with the Status of the contact laws, in ContactEntries::status.
class EscapeGuard {
 public:
  explicit EscapeGuard(mjtNum& status) : state_(&status) {}  // ContactEntries::status

  // The Status in that number.
  static Status status_in(double number) {
    return static_cast<Status>(static_cast<int>(number) % kWasInside);
  }
  Status status() const { return status_in(*state_); }
  void set_status(Status status) { set(bits() - bits() % kWasInside + static_cast<int>(status)); }
  // Sets the Status of this step. Warns once and not in every step, because MuJoCo writes its
  // warnings to a file.
  void record(Status now) {
    if (now != Status::kOk && status() == Status::kOk) {
      warn("rotorub: the contact laws have no solution or several (Painleve): no impulse");
    }
    set_status(now);
  }
  bool is_outside() const { return (bits() & kIsOutside) != 0; }

  // Call it if the state was written or is the first one: the rotor may then be anywhere.
  void begin() { set(bits() & ~(kWasInside | kIsOutside)); }
  // Call it in every pass. gap, clearance: m, time: s.
  void watch(double gap, double clearance, double time) {
    constexpr double kDeep = 0.01;  // share of the clearance
    const bool inside = gap >= -kDeep * clearance;
    const bool escaped = !inside && (bits() & kWasInside);
    set((bits() & ~kIsOutside) | (inside ? kWasInside : 0) | (escaped ? kIsOutside : 0));
    if (!escaped || (bits() & kWasTold)) return;
    const auto micrometres = [](double metres) { return std::round(1e7 * metres) / 10.0; };
    set(bits() | kWasTold);
    warn(
        message("rotorub: the rotor is {} um deep in its ring (clearance {} um) at t = {} s; use a "
                "shorter step, or check for forces that move rotor or ring apart from the "
                "contact; rotorub_active is 0 while that lasts",
                micrometres(-gap), micrometres(clearance), time)
            .c_str());
  }

 private:
  enum { kWasInside = 16, kIsOutside = 32, kWasTold = 64 };
  int bits() const { return static_cast<int>(*state_); }
  void set(int bits) { *state_ = bits; }

  mjtNum* state_;
};

// Further results of a contact in the last pass of this thread, for load_cells.h.
struct NotedContact {
  const mjData* d = nullptr;
  double time = 0.0;
  int data = -1;
  Eigen::Vector2d e_r;
  double axial = 0.0;  // N, friction on the rotor along the ring's axis
};

// The results in the last pass of this thread, for the contact whose entries begin at `data`.
const NotedContact& noted_contact(int data);

// Records the results of the contact whose entries begin at `data`: the normal of its force in this
// pass, in the contact's axes, and the friction on the rotor along the ring's axis, N. The normal
// of an impact within the step differs from the normal in the present state. Called for `rigid`
// with a force, and for contacts with friction along the axis.
void note_contact(const mjData* d, int data, const Eigen::Vector2d& e_r, double axial = 0.0);

// The memory of a `rigid` contact in mjData.userdata: whether contact lasts, and the impulses of
// the step.
class ContactMemory {
 public:
  // The memory for the forward pass at d->time. A pass one step (h, s) later turns "now" into
  // "before"; further passes at the same time (mj_forward before mj_step) find the same "before".
  // At any other time the state was written, so no lasting contact is assumed.
  ContactMemory(mjData* d, const ContactPair& pair, double h)
      : d_(d), pair_(pair), entry_(contact_entries(pair, d)), h_(h) {
    if (entry_.time == d->time) return;
    const double passed = d->time - entry_.time;
    const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(d->time);
    const bool next = std::abs(passed - h) <= 1e-6 * h + rounding;
    entry_.time = d->time;
    entry_.before = next ? entry_.now : 0.0;
    if (!next) EscapeGuard(entry_.status).begin();
  }

  // True if contact lasted over the previous step. A lasting contact ends on the circle. If the
  // centres are closer than that (delta, m), the state was written since.
  bool was_in_contact(double delta) const {
    constexpr double kOnCircle = 0.01;  // gap that a step may leave, as a share of the clearance
    return was_in_contact() && delta > (1.0 - kOnCircle) * pair_.contact.clearance;
  }
  bool was_in_contact() const { return entry_.before != 0.0; }

  // Watches the gap in this pass. delta: m, distance of the centres.
  void watch(double delta) {
    if (pair_.contact.impact_time() > 0.0) return;  // such an impact penetrates the ring
    const double clearance = pair_.contact.clearance;
    EscapeGuard(entry_.status).watch(clearance - delta, clearance, d_->time);
  }
  void begin_anew() { EscapeGuard(entry_.status).begin(); }

  // True if the previous step had no solution and the user was warned.
  bool warned() const { return EscapeGuard(entry_.status).status() != Status::kOk; }

  // Records the results. The forces are means over the step.
  void note(const RigidResult& r) {
    entry_.now = r.mode == Mode::kFree ? 0.0 : 1.0;  // remember_places() replaces the 1
    entry_.mode = static_cast<double>(r.mode);
    entry_.normal_force = r.normal / h_;
    entry_.friction_force = r.friction / h_;
    EscapeGuard guard(entry_.status);
    if (r.converged) {
      guard.record(r.status);
    } else {
      guard.set_status(r.status);
    }
    entry_.impact = r.impact ? 1.0 : 0.0;
    if (r.normal > 0.0) note_contact(d_, pair_.data, r.e_r);
    if (!r.impact) return;
    entry_.gap_rate_before = r.gap_rate_before;
    entry_.gap_rate_after = r.gap_rate_after;
    entry_.slip_before = r.slip_before;
    entry_.slip_after = r.slip_after;
  }

 private:
  const mjData* d_;
  const ContactPair& pair_;
  ContactEntries& entry_;
  double h_;  // s
};

// The pair's contact in mjData.contact; null if there is none or MuJoCo's solver does not solve it.
const mjContact* find_contact(const ContactPair& pair, const mjData* d);

// The contact forces of a forward pass, for all contact models.
struct ContactForces {
  double normal = 0.0;    // N, >= 0
  double friction = 0.0;  // N, on the rotor along e_t
  Mode mode = Mode::kFree;
  // For `rigid`: true if the forces are an impact's impulses divided by the step. Rates before and
  // after the impact, m/s.
  bool impact = false;
  double impact_time = 0.0;  // s; 0: unknown (segments, own models)
  double gap_rate_before = 0.0, gap_rate_after = 0.0, slip_before = 0.0, slip_after = 0.0;
  Status status = Status::kOk;  // of the contact laws, for `rigid`
};

// The contact forces of the last forward pass, after mj_forward or mj_step: of the pair, or of the
// first contact of the config.
ContactForces contact_forces(const Config& config, const mjModel* m, const mjData* d);
ContactForces contact_forces(const ContactPair& pair, const mjModel* m, const mjData* d);

// Normal force of a compliant contact in this pass, N. mjData.userdata keeps the factor a of the
// touch while it lasts. A contact that begins closed (CompliantLaw::begins_closed) has no touching
// speed: this happens in the first pass after a reset or a keyframe, and after a program wrote the
// state. A written state is recognised by its time, or by a gap that the motion cannot have
// produced.
double compliant_force(const ContactPair& pair, const ContactPoint& point, const mjModel* m,
                       mjData* d);
// Call it instead of compliant_force in a pass in which MuJoCo does not have the contact.
void pass_without_contact(const ContactPair& pair, const mjModel* m, mjData* d);

}  // namespace rotorub::plugin
