// What `rigid` keeps in mjData.userdata: whether contact lasts, and what the step's impulses were.
#pragma once

#include <cmath>
#include <limits>

#include <mujoco/mujoco.h>

#include "plugin/contact/rigid_law.h"
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
  }

  bool was_in_contact() const { return entry_[kContactBefore] != 0.0; }

  // The step before had no solution, and that was said.
  bool warned() const { return entry_[kContactStatus] != 0.0; }

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
    entry_[kContactStatus] = static_cast<double>(r.status);
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
