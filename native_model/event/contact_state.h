// What a contact does next: pure functions of what holds at one instant. One contact's state; a
// shaft with two auxiliary bearings has two of them. A contact that gives (contact/compliance.h)
// presses with a force that is known, and only its friction is to be decided.
#pragma once

#include <optional>
#include <span>

#include "native_model/contact/coupled_law.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// How a flight begins. On the circle F = |d|^2 - delta_0^2 has a root at its start that is known
// exactly (location.h): a single one after an impact (gap 0), a double one where contact ends by a
// jump of the loads (gap and gap rate 0), a triple one after a lift-off (gap acceleration 0 too).
enum class Departure { kInside = 0, kRebound = 1, kParting = 2, kLiftOff = 3 };

struct ContactState {
  Mode mode = Mode::kFree;
  double slip_sign = 1.0;                    // sliding only: sign of gdot_T
  Departure departure = Departure::kInside;  // free only: how the flight began
  // Free only: it carries nothing, and yet others that are closed keep it on its circle, as three
  // rings a rotor of two degrees of freedom in a plane. Its gap is then 0 but for round-off, whose
  // sign is no touch.
  bool held = false;
  double held_gap = 0.0;  // m, <= 0, the gap at which it is held
  // Of a contact that gives: a of this touch, s/m; free only: still in the wall, which no longer
  // presses.
  double hunt_crossley = 0.0;
  bool in_wall = false;
};
constexpr ContactState in_flight(Departure how) { return {Mode::kFree, 1.0, how}; }
// One that opens beside closed ones, which may hold it.
constexpr ContactState held_by_others(Departure how) { return {Mode::kFree, 1.0, how, true}; }

struct ContactDecisions {
  Status status = Status::kOk;  // else the laws have no solution, or several (Painleve)
  const char* reason = "";      // of a status that is not ok
  ContactList<ContactState> next{};
};

// Contacts on their circles with gap rate 0, solved together: free, sliding or sticking from here
// on, in the order of b. b and scale as Phase::Accelerations; slips: m/s, exactly 0 where it is
// known to be, and the set-valued friction law decides; friction: mu at the slip; pressing: N, of
// those that give, else none; empty: all are rigid. no_force: see EventParameters.
ContactDecisions select_contact_modes(const ContactMatrix& g, const ContactVector& b,
                                      const ContactVector& scale, std::span<const double> slips,
                                      std::span<const double> friction, double no_force,
                                      std::span<const std::optional<double>> pressing = {});

// Margins of lasting contact, positive while it lasts.
struct Margins {
  double
      force;  // N, lambda_N; of a contact that gives CompliantLaw::margin, in the wall its spring
  // Sliding: m/s of slip along its sign; sticking: N, mu lambda_N - |lambda_T|; free in the wall:
  // N, by how much it does not press.
  double cone;
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
