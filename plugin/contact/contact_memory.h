// The memory of a contact in mjData.userdata and in its thread, and its forces after a forward
// pass.
#pragma once

#include <mujoco/mujoco.h>

#include "native_model/contact/kinematics.h"
#include "native_model/trajectory/trajectory.h"
#include "plugin/contact/contact_status.h"
#include "plugin/contact/rigid_step.h"
#include "plugin/model/config.h"
#include "plugin/model/user_data.h"

namespace rotorub::plugin {

// Further results of a contact in a pass of this thread, for load_cells.h.
struct NotedContact {
  double time = 0.0;              // s, of the pass
  Eigen::Vector2d e_r{1.0, 0.0};  // normal of the force, in the contact's axes
  double axial = 0.0;             // N, friction on the rotor along the ring's axis
  double normal = 0.0;            // N, normal force in the contact's entries, which they belong to
};

// The results that this thread noted last for the contact whose entries begin at `userdata`; null
// if there are none.
const NotedContact* noted_contact(const mjData* d, int userdata);

// Records the results of the contact whose entries begin at `userdata`: the normal of its force in
// this pass, and the friction along the axis, N. The normal of an impact within the step differs
// from the normal in the present state. Called for `rigid` with a force, and for contacts with
// friction along the axis.
void note_contact(const mjData* d, int userdata, const Eigen::Vector2d& e_r, double axial = 0.0);

// Watches the gap of a `rigid` contact in this pass (ContactStatus). delta: m, distance of the
// centres.
void watch_escape(const ContactPair& pair, mjData* d, double delta);

// Records the mode and the forces of a contact in its entries: N, the normal force and the friction
// on the rotor along e_t.
inline void record_forces(ContactEntries& entry, ContactMode mode, double normal, double friction) {
  entry.mode = static_cast<double>(mode);
  entry.normal_force = normal;
  entry.friction_force = friction;
}

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
    const bool next = is_next_step(d->time - entry_.time, h, d->time);
    entry_.time = d->time;
    entry_.before = next ? entry_.now : 0.0;
    if (!next) begin_anew();
  }

  // True if contact lasted over the previous step. A lasting contact ends on the circle. If the
  // centres are closer than that (delta, m), the state was written since.
  bool was_in_contact(double delta) const {
    constexpr double kMostGapOfStep = 0.01;  // that a step may leave, as a share of the clearance
    return was_in_contact() && delta > (1.0 - kMostGapOfStep) * pair_.contact.clearance;
  }
  bool was_in_contact() const { return entry_.before != 0.0; }

  // Watches the gap in this pass. delta: m, distance of the centres.
  void watch(double delta) { watch_escape(pair_, d_, delta); }
  void begin_anew() { ContactStatus(entry_.status).begin(); }

  // True if the previous step had no solution and the user was warned.
  bool warned() const { return ContactStatus(entry_.status).status() != Status::kOk; }

  // Records the results of a step in which the contact is open.
  void note_open() { note({}, 0.0); }
  // Records the results. The forces are means over the step. delta: m, distance of the centres in
  // this pass.
  void note(const RigidResult& r, double delta) {
    entry_.now = r.mode == ContactMode::kFree ? 0.0 : delta;
    record_forces(entry_, r.mode, r.normal / h_, r.friction / h_);
    ContactStatus status(entry_.status);
    if (r.converged) {
      status.record(r.status);
    } else {
      status.set_status(r.status);
    }
    entry_.impact = r.impact ? 1.0 : 0.0;
    if (r.normal > 0.0) note_contact(d_, pair_.userdata, r.e_r);
    if (!r.impact) return;
    entry_.gap_rate_before = r.gap_rate_before;
    entry_.gap_rate_after = r.gap_rate_after;
    entry_.slip_before = r.slip_before;
    entry_.slip_after = r.slip_after;
  }

 private:
  mjData* d_;
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
  ContactMode mode = ContactMode::kFree;
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
