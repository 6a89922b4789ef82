// What `rigid` keeps in mjData.userdata: whether contact lasts, and what the step's impulses were.
#pragma once

#include <cmath>
#include <limits>

#include <mujoco/mujoco.h>

#include "native_model/contact/rigid_law.h"
#include "plugin/contact/escape_guard.h"
#include "plugin/load_cells.h"
#include "plugin/mujoco_versions.h"
#include "plugin/user_data.h"

namespace rotorub::plugin {

class ContactMemory {
 public:
  // Of the forward pass at d->time. A pass one step (h, s) later turns "now" into "before"; further
  // passes at the same time (mj_forward before mj_step) find the same "before". Any other time was
  // written: no contact lasts into it.
  ContactMemory(mjData* d, int data, double h) : d_(d), data_(data), entry_(d->userdata + data) {
    if (entry_[kContactTime] == d->time) return;
    const double passed = d->time - entry_[kContactTime];
    const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(d->time);
    const bool next = std::abs(passed - h) <= 1e-6 * h + rounding;
    entry_[kContactTime] = d->time;
    entry_[kContactBefore] = next ? entry_[kContactNow] : 0.0;
    if (!next) EscapeGuard(entry_).begin();
  }

  // Whether contact lasted over the step before. It ends on the circle: a centre `delta` from the
  // ring's that is inside it was written since.
  bool was_in_contact(double delta, double clearance) const {
    constexpr double kOnCircle = 0.01;  // of the clearance, that a step may leave open
    return was_in_contact() && delta > (1.0 - kOnCircle) * clearance;
  }
  bool was_in_contact() const { return entry_[kContactBefore] != 0.0; }

  // Of this pass; delta: m, between the centres.
  void watch(double delta, const ContactParameters& c) {
    const bool gives = c.impact_time() > 0.0;  // an impact that takes time goes deep
    if (!gives) EscapeGuard(entry_).watch(c.clearance - delta, c.clearance, d_->time);
  }
  void begin_anew() { EscapeGuard(entry_).begin(); }

  // The step before had no solution, and that was said.
  bool warned() const { return EscapeGuard(entry_).status() != Status::kOk; }

  // Forces are means over the step of length h (s).
  void note(const RigidResult& r, double h) {
    entry_[kContactNow] = r.mode == Mode::kFree ? 0.0 : 1.0;
    entry_[kMode] = static_cast<double>(r.mode);
    entry_[kNormalForce] = r.normal / h;
    entry_[kFrictionForce] = r.friction / h;
    // Once, not every step: MuJoCo writes its warnings to a file.
    if (r.status != Status::kOk && r.converged && !warned()) {
      warn("rotorub: the contact laws have no solution or several (Painleve): no impulse");
    }
    EscapeGuard(entry_).set_status(r.status);
    entry_[kImpact] = r.impact ? 1.0 : 0.0;
    if (r.normal > 0.0) note_contact(d_, data_, r.e_r);
    if (!r.impact) return;
    entry_[kGapRateBefore] = r.gap_rate_before;
    entry_[kGapRateAfter] = r.gap_rate_after;
    entry_[kSlipBefore] = r.slip_before;
    entry_[kSlipAfter] = r.slip_after;
  }

 private:
  const mjData* d_;
  int data_;
  mjtNum* entry_;
};

}  // namespace rotorub::plugin
