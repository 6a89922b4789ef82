#include "native_model/event/contact_state.h"

#include <cmath>

#include "native_model/contact/planar_contact.h"
#include "native_model/trajectory/status_reason.h"

namespace rotorub {

namespace {

constexpr ContactState kParts = in_flight(Departure::kParting);
// Relative to the accelerations; a contact whose gap opens no faster is redundant.
constexpr double kRedundant = 1e-8;

// A single sliding contact parts or slides on by the sign of its normal acceleration, however
// small. solve_coupled() would decide otherwise near 0, because it counts what is below its
// round-off of the largest acceleration, also the tangential one, as 0. Where several solutions
// exist (Painleve), it would also select one if it can, while this function reports them.
ContactDecisions sliding_alone(const Delassus& g, double normal, double slip, double mu) {
  const double sign = slip > 0.0 ? 1.0 : -1.0;
  ContactDecisions decided;
  if (sliding_coefficient(g, mu * sign) <= 0.0) {
    const bool closing = normal < 0.0;
    decided.status = closing ? Status::kNoSolution : Status::kAmbiguous;
    decided.reason = closing ? "frictional jamming (Painleve): sliding wedges the contact, and the "
                               "contact forces have no solution"
                             : "frictional jamming (Painleve): sliding wedges the contact, and the "
                               "contact forces have several solutions";
  } else {
    decided.next.push_back(normal >= 0.0 ? kParts : ContactState{ContactMode::kSlide, sign});
  }
  return decided;
}

}  // namespace

ContactDecisions select_contact_modes(const ContactMatrix& g, const ContactVector& b,
                                      const ContactVector& scale, std::span<const double> slips,
                                      std::span<const double> friction, double no_force,
                                      std::span<const std::optional<double>> compliant_force) {
  ContactVector adjusted = b;
  ContactList<ContactSet> sets;
  for (std::size_t i = 0; i < slips.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    // On an orbit as wide as the clearance the ring transmits only round-off, of either sign. This
    // counts as lasting contact with a force near 0.
    const double none = no_force * scale[at];
    ContactSet set;
    if (!compliant_force.empty() && compliant_force[i]) {
      set.normal_known = true;
      set.least_normal = *compliant_force[i];
    } else if (std::abs(b[2 * at]) < none) {
      adjusted[2 * at] = -none;
    }
    set.friction = friction[i];
    set.slides = slips[i] > 0.0 ? 1.0 : slips[i] < 0.0 ? -1.0 : 0.0;
    sets.push_back(set);
  }
  if (slips.size() == 1 && slips[0] != 0.0 && !sets[0].normal_known) {
    return sliding_alone({g(0, 0), g(0, 1), g(1, 0), g(1, 1)}, adjusted[0], slips[0], friction[0]);
  }
  const CoupledSolution s = solve_coupled(g, adjusted, sets);
  ContactDecisions decided;
  if (!s.is_unique()) {
    decided.status = status_of(s.solutions);
    decided.reason = s.solutions == 0 ? "the contact forces have no solution (Painleve)"
                                      : "the contact forces have several solutions (Painleve)";
    return decided;
  }
  for (std::size_t i = 0; i < slips.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(2 * i);
    if (!(s.p[at] > 0.0) && !sets[i].normal_known) {
      const bool redundant =
          slips.size() > 1 && s.y[at] <= kRedundant * scale[static_cast<Eigen::Index>(i)];
      decided.next.push_back(redundant ? redundant_contact(Departure::kParting) : kParts);
    } else if (sets[i].slides != 0.0) {
      decided.next.push_back({ContactMode::kSlide, sets[i].slides});
    } else if (s.sticks[i] ||
               (sets[i].normal_known && sets[i].least_normal == 0.0 && friction[i] > 0.0)) {
      // A contact that closes without slip sticks until its friction decides.
      decided.next.push_back({ContactMode::kStick, 0.0});
    } else {
      // It slides against its friction, because its slip is only round-off among contacts that
      // stick.
      const double force = s.p[at + 1];
      const double sign = force != 0.0 ? -force : s.y[at + 1];
      decided.next.push_back({ContactMode::kSlide, sign > 0.0 ? 1.0 : -1.0});
    }
  }
  return decided;
}

PhaseEnd end_of_phase(ContactMode mode, const Margins& margins, const MarginScales& scales) {
  if (margins.force / scales.force <= margins.tangential / scales.tangential(mode))
    return PhaseEnd::kOpens;
  return mode == ContactMode::kSlide ? PhaseEnd::kSlipStops : PhaseEnd::kSlipBegins;
}

std::optional<EventKind> event_between(const ContactState& from, const ContactState& to) {
  if (from.mode != to.mode) return mode_event(to.mode);
  if (to.mode == ContactMode::kSlide && from.slip_sign != to.slip_sign) return EventKind::kReverse;
  return {};
}

}  // namespace rotorub
