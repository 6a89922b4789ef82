#include "native_model/event/contact_state.h"

#include <cmath>

#include "native_model/contact/planar_contact.h"

namespace rotorub {

namespace {

// Of one that slides the case is known: it parts, or it slides on.
ContactDecision sliding_alone(const Delassus& g, double normal, double slip, double mu,
                              const ContactState& free) {
  const double sign = slip > 0.0 ? 1.0 : -1.0;
  if (carried(g, mu * sign) <= 0.0) {
    const bool closing = normal < 0.0;
    return {closing ? Status::kNoSolution : Status::kAmbiguous, free,
            closing ? "frictional jamming (Painleve): sliding pushes itself in, and the contact "
                      "forces have no solution"
                    : "frictional jamming (Painleve): sliding pushes itself in, and the contact "
                      "forces have several solutions"};
  }
  return {Status::kOk, normal >= 0.0 ? free : ContactState{Mode::kSlide, sign}};
}

}  // namespace

ContactDecisions select_contact_modes(const ContactMatrix& g, const ContactVector& b,
                                      const ContactVector& scale, std::span<const double> slips,
                                      std::span<const double> friction, double no_force,
                                      Departure parting) {
  const std::size_t n = slips.size();
  ContactVector pressed = b;
  std::array<ContactSet, kMaxContacts> sets{};
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    // On an orbit as wide as the clearance the ring carries nothing but round-off, of either sign:
    // lasting contact, next to without force.
    const double none = no_force * scale[at];
    if (std::abs(b[2 * at]) < none) pressed[2 * at] = -none;
    sets[i].friction = friction[i];
    sets[i].slides = slips[i] > 0.0 ? 1.0 : slips[i] < 0.0 ? -1.0 : 0.0;
  }
  ContactDecisions decisions{};
  const ContactState free{Mode::kFree, 1.0, parting};
  if (n == 1 && slips[0] != 0.0) {
    const Delassus own{g(0, 0), g(0, 1), g(1, 0), g(1, 1)};
    decisions[0] = sliding_alone(own, pressed[0], slips[0], friction[0], free);
    return decisions;
  }
  const CoupledSolution s = solve_coupled(g, pressed, std::span(sets).first(n));
  if (s.solutions != 1) {
    decisions[0] = {status_of(s.solutions),
                    {},
                    s.solutions == 0 ? "the contact forces have no solution (Painleve)"
                                     : "the contact forces have several solutions (Painleve)"};
    return decisions;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<Eigen::Index>(2 * i);
    ContactState& next = decisions[i].next;
    if (!(s.p[at] > 0.0)) {
      next = free;
    } else if (sets[i].slides != 0.0) {
      next = {Mode::kSlide, sets[i].slides};
    } else if (s.sticks[i]) {
      next = {Mode::kStick, 0.0};
    } else {
      next = {Mode::kSlide, s.y[at + 1] > 0.0 ? 1.0 : -1.0};
    }
  }
  return decisions;
}

PhaseEnd end_of_phase(Mode mode, const Margins& margins, const MarginScales& scales) {
  if (margins.force / scales.force <= margins.cone / scales.cone(mode)) return PhaseEnd::kOpens;
  return mode == Mode::kSlide ? PhaseEnd::kSlipStops : PhaseEnd::kSlipBegins;
}

std::optional<EventKind> event_between(const ContactState& from, const ContactState& to) {
  if (from.mode != to.mode) {
    return to.mode == Mode::kFree    ? EventKind::kLiftOff
           : to.mode == Mode::kSlide ? EventKind::kSlide
                                     : EventKind::kStick;
  }
  if (to.mode == Mode::kSlide && from.slip_sign != to.slip_sign) return EventKind::kReverse;
  return {};
}

}  // namespace rotorub
