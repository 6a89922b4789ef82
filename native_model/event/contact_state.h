// The decisions about what contacts do next, as pure functions of the values at one instant. Each
// auxiliary bearing has one contact with its own state. The normal force of a compliant contact
// (contact/compliance.h) is known, so only its friction is decided.
#pragma once

#include <optional>
#include <span>

#include "native_model/contact/coupled_law.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// A flight begins in one of these ways. If it begins on the circle, F = |d|^2 - delta_0^2 has a
// known root at its start (location.h): a single root after an impact (gap 0), a double root if
// contact ends by a jump of the loads (gap and gap rate 0), a triple root after a lift-off (gap
// acceleration 0 too).
enum class Departure { kInside = 0, kRebound = 1, kParting = 2, kLiftOff = 3 };

struct ContactState {
  ContactMode mode = ContactMode::kFree;
  double slip_sign = 1.0;                    // only if sliding: sign of gdot_T
  Departure departure = Departure::kInside;  // only if free: how the flight began
  // Only if free: a redundant contact transmits no force, but other closed contacts keep it on its
  // circle, such as three rings about a rotor with two degrees of freedom in a plane. Its gap is
  // then 0 up to round-off, whose sign is not a touch.
  bool redundant = false;
  double redundant_gap = 0.0;  // m, <= 0, gap at which it is kept
  // Only for compliant contacts: a of this touch, s/m; and, if free, true while the rotor is still
  // in the wall, but without a force.
  double hunt_crossley = 0.0;
  bool in_wall = false;
};
constexpr ContactState in_flight(Departure how) { return {ContactMode::kFree, 1.0, how}; }
// A contact that opens while others are closed, which may keep it on its circle.
constexpr ContactState redundant_contact(Departure how) {
  return {ContactMode::kFree, 1.0, how, true};
}

struct ContactDecisions {
  Status status = Status::kOk;  // otherwise the laws have no solution or several (Painleve)
  const char* reason = "";      // for a status other than kOk
  ContactList<ContactState> next{};
};

// Decides about contacts on their circles with gap rate 0, solved together: free, sliding or
// sticking from here on, in the order of b. b, scale: as in SmoothSystem::Accelerations; slips:
// m/s, exactly 0 if the contact is known not to slip, so that the set-valued friction law decides;
// friction: mu at the slip; compliant_force: N, for compliant contacts only, empty if all are
// rigid; no_force: see EventParameters.
ContactDecisions select_contact_modes(const ContactMatrix& g, const ContactVector& b,
                                      const ContactVector& scale, std::span<const double> slips,
                                      std::span<const double> friction, double no_force,
                                      std::span<const std::optional<double>> compliant_force = {});

// Margins of lasting contact; they are positive while it lasts.
struct Margins {
  double force;  // N, lambda_N; if compliant, CompliantLaw::margin(); in the wall, its spring part
  // Sliding: m/s, slip along its sign. Sticking: N, mu lambda_N - |lambda_T|. Free in the wall: N,
  // negative of CompliantLaw::margin().
  double tangential;
};
// Typical sizes of the margins.
struct MarginScales {
  double force, speed;  // N, m/s
  double tangential(ContactMode mode) const { return mode == ContactMode::kSlide ? speed : force; }
};

// The end of a phase when one of its margins is reached.
enum class PhaseEnd { kOpens, kSlipStops, kSlipBegins };
PhaseEnd end_of_phase(ContactMode mode, const Margins& margins, const MarginScales& scales);

// The event that a change from one state to the next is; empty if the change is not an event.
std::optional<EventKind> event_between(const ContactState& from, const ContactState& to);

}  // namespace rotorub
