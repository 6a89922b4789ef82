// What a contact does next: pure functions of what holds at one instant. One contact's state; a
// shaft with two auxiliary bearings has two of them.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "native_model/contact/coupled_law.h"
#include "native_model/event/first_contact.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

struct ContactState {
  Mode mode = Mode::kFree;
  double slip_sign = 1.0;                    // sliding only: sign of gdot_T
  Departure departure = Departure::kInside;  // free only: how the flight began
};

// What lasting contact needs: y = G L + b with forces L and accelerations y, (12)-(13).
struct ContactAccelerations {
  Delassus g;          // 1/kg
  double normal;       // m/s^2, gddot_N without contact force
  double tangential;   // m/s^2, gddot_T without contact force
  double scale = 0.0;  // m/s^2, of what adds up to `normal`
};

struct ContactDecision {
  Status status = Status::kOk;  // else the laws have no solution, or several (Painleve)
  ContactState next{};
  const char* reason = "";  // of a status that is not ok
};

// On the circle with gap rate 0: free, sliding or sticking from here on. slip: m/s, exactly 0 where
// it is known to be, and the set-valued friction law decides. mu: that of the slip. `parting`: how
// a flight would begin. no_force: see EventParameters.
ContactDecision select_contact_mode(const ContactAccelerations& b, double slip, double mu,
                                    double no_force, Departure parting);

// Several contacts on their circles with gap rate 0, solved together: b and scale as
// Phase::Accelerations, slips as above. The decisions of all, in the order of b; a status that is
// not ok is in the first.
using ContactDecisions = std::array<ContactDecision, kMaxContacts>;
ContactDecisions select_contact_modes(const ContactMatrix& g, const ContactVector& b,
                                      const ContactVector& scale, std::span<const double> slips,
                                      std::span<const double> friction, double no_force,
                                      Departure parting);

// Margins of lasting contact, positive while it lasts.
struct Margins {
  double force;  // N, lambda_N
  double cone;   // sliding: m/s of slip along its sign; sticking: N, mu lambda_N - |lambda_T|
};
// What they are measured by.
struct MarginScales {
  double force, speed;  // N, m/s
  double cone(Mode mode) const { return mode == Mode::kSlide ? speed : force; }
};

// A margin is reached: which one?
enum class PhaseEnd { kOpens, kSlipStops, kSlipBegins };
PhaseEnd end_of_phase(Mode mode, const Margins& margins, const MarginScales& scales);

// The event that a change from one state to the next is; empty: none.
std::optional<EventKind> event_between(const ContactState& from, const ContactState& to);

}  // namespace rotorub
