// How a contact fares: the Status of the contact laws, and flags of what was noticed and of which
// warnings were issued. All of them are one number in mjData.userdata, ContactEntries::status.
#pragma once

#include <mujoco/mujoco.h>

#include <cmath>

#include "native_model/numerics/status.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {

// Bits of ContactEntries::status above the Status.
enum ContactFlag : int {
  kWasInside = 16,      // the rotor was within its clearance since its state was last written
  kIsOutside = 32,      // it penetrates the wall although it was within its clearance
  kEscapeWarned = 64,   // the user was warned of that
  kInSolver = 128,      // only in the first contact: MuJoCo's solver solves a contact of the plugin
  kSolverWarned = 256,  // only in the first contact: the user was warned that the solver stopped
  kStartWarned = 512    // the user was warned that the rotor starts far outside
};

// Reads and writes the number.
class ContactStatus {
 public:
  explicit ContactStatus(mjtNum& number) : number_(&number) {}  // ContactEntries::status

  // The Status in that number.
  static Status status_in(double number) {
    return static_cast<Status>(static_cast<int>(number) % kWasInside);
  }
  Status status() const { return status_in(*number_); }
  void set_status(Status status) {
    *number_ = bits() - bits() % kWasInside + static_cast<int>(status);
  }
  bool has(ContactFlag flag) const { return (bits() & flag) != 0; }
  void set(ContactFlag flag, bool on) { *number_ = on ? bits() | flag : bits() & ~flag; }

  // Sets the Status of this step. Warns once and not in every step, because MuJoCo writes its
  // warnings to a file.
  void record(Status now) {
    if (now != Status::kOk && status() == Status::kOk) {
      warn(
          "rotorub: the contact laws have no unique solution (Painleve), so this step has no "
          "contact impulse; lower the friction");
    }
    set_status(now);
  }

  // Call it if the state was written or is the first one: the rotor may then be anywhere.
  void begin() {
    set(kWasInside, false);
    set(kIsOutside, false);
  }
  // Call it in every pass of a `rigid` contact whose impacts take no time. A rotor that was within
  // its clearance does not penetrate the wall by more than kDeep. If one does, the step is too long
  // for its motion, or something that the contact does not see moves rotor or ring. The user is
  // warned once, and `rotorub_active` is 0 meanwhile. A rotor that starts in the wall is pushed out
  // slowly; if it starts deeper than the clearance, the user is warned once. gap, clearance: m,
  // time: s.
  void watch_escape(double gap, double clearance, double time) {
    constexpr double kDeep = 0.01;  // share of the clearance
    const bool inside = gap >= -kDeep * clearance;
    const bool escaped = !inside && has(kWasInside);
    set(kIsOutside, escaped);
    if (inside) set(kWasInside, true);
    // MuJoCo takes a step at time 0 while it compiles a model, from which no run starts.
    const bool starts_outside = time > 0.0 && !has(kWasInside) && gap < -clearance;
    const ContactFlag warned = escaped ? kEscapeWarned : kStartWarned;
    if (!(escaped || starts_outside) || has(warned)) return;
    set(warned, true);
    const auto micrometres = [](double metres) { return std::round(1e7 * metres) / 10.0; };
    if (starts_outside) {
      warn(
          message("rotorub: the rotor starts {} um outside its ring (clearance {} um) at t = {} s, "
                  "and the contact only pushes it back slowly; start it in the ring, or check the "
                  "positions of both geoms and the clearance",
                  micrometres(-gap), micrometres(clearance), time)
              .c_str());
      return;
    }
    warn(
        message("rotorub: the rotor is {} um deep in its ring (clearance {} um) at t = {} s; use a "
                "shorter step, or check for forces that move rotor or ring apart from the "
                "contact; rotorub_active is 0 while that lasts",
                micrometres(-gap), micrometres(clearance), time)
            .c_str());
  }

 private:
  int bits() const { return static_cast<int>(*number_); }

  mjtNum* number_;
};

}  // namespace rotorub::plugin
