// Under `rigid` no rotor is deeper in its ring than a start put it: where one is, the step is too
// long for its motion, or something moves rotor or ring that the contact does not see. That is said
// once, and `rotorub_active` is 0 meanwhile. What it knows stands beside the Status of the contact
// laws, in kContactStatus.
#pragma once

#include <mujoco/mujoco.h>

#include "native_model/trajectory/trajectory.h"
#include "plugin/message.h"
#include "plugin/mujoco_versions.h"
#include "plugin/user_data.h"

namespace rotorub::plugin {

class EscapeGuard {
 public:
  // entry: of a contact, as of kFrictionForce and the others.
  explicit EscapeGuard(mjtNum* entry) : state_(entry + kContactStatus) {}

  // Of the number in kContactStatus.
  static Status status_in(double number) {
    return static_cast<Status>(static_cast<int>(number) % kWasInside);
  }
  Status status() const { return status_in(*state_); }
  void set_status(Status status) { set(bits() - bits() % kWasInside + static_cast<int>(status)); }
  bool is_outside() const { return (bits() & kIsOutside) != 0; }

  // The state was written, or is the first: it may be anywhere.
  void begin() { set(bits() & ~(kWasInside | kIsOutside)); }
  // In every pass. gap, clearance: m, time: s.
  void watch(double gap, double clearance, double time) {
    constexpr double kDeep = 0.01;  // of the clearance
    const bool inside = gap >= -kDeep * clearance;
    const bool escaped = !inside && (bits() & kWasInside);
    set((bits() & ~kIsOutside) | (inside ? kWasInside : 0) | (escaped ? kIsOutside : 0));
    if (!escaped || (bits() & kWasTold)) return;
    set(bits() | kWasTold);
    warn(message("rotorub: the rotor is {} m deep in its ring at t = {} s, with a clearance of {} "
                 "m: the step is too long "
                 "for this motion, or rotor or ring is moved by what the contact does not see; "
                 "rotorub_active is 0 while "
                 "that lasts",
                 -gap, time, clearance)
             .c_str());
  }

 private:
  enum { kWasInside = 16, kIsOutside = 32, kWasTold = 64 };
  int bits() const { return static_cast<int>(*state_); }
  void set(int bits) { *state_ = bits; }

  mjtNum* state_;
};

}  // namespace rotorub::plugin
