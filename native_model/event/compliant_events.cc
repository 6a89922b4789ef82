// Events at compliant contacts (contact/compliance.h): touch, release, stick and slip.

#include "native_model/event/driver.h"
#include "native_model/model/dynamics.h"

namespace rotorub {
namespace {

constexpr double kOpen = 1e-12;  // relative to the largest force; less counts as 0
// Relative to the largest spring force; less counts as no penetration.
constexpr double kInWall = 1e-9;

}  // namespace

// A contact that begins closed has no touch; a contact that closes while on its circle has one.
void EventIntegrator::begin_in_walls() {
  for (std::size_t k = 0; k < system_.contacts(); ++k) {
    if (!model_->auxiliary[k].is_compliant()) continue;
    const ContactPoint p = contact_point(*model_, motion_.q(), motion_.v(), k);
    const ContactParameters& contact = *model_->auxiliary[k].contact;
    if (CompliantLaw::begins_closed(p.gap, p.gap_rate, contact.clearance)) {
      begin_touch(k, contact.compliance.a_of_start());
    } else if (is_on_circle(p.gap, contact.clearance) && p.gap_rate < 0.0) {
      begin_touch(k, contact.compliance.a_of_touch(-p.gap_rate));
    }
  }
}

// The contact has a force from here on, with this a, s/m. Its friction is decided together with all
// other contacts.
void EventIntegrator::begin_touch(std::size_t k, double hunt_crossley) {
  first_touch(k);
  const ClosedContact touch{k, contact_point(*model_, motion_.q(), motion_.v(), k)};
  // A contact that touches without speed may part again at once.
  if (touch.point.gap >= 0.0 && touch.point.gap_rate >= 0.0 && parting_acceleration(k) >= 0.0) {
    return system_.set(k, in_flight(Departure::kParting));
  }
  ContactState state;
  state.hunt_crossley = hunt_crossley;
  state.in_wall = true;
  system_.set(k, state);
  observer_.begin_touch(motion_, touch);
  decide_one(k, Constraint::Velocity::kAny);
}

// m/s^2, gddot_N of a contact without a force, under the loads and the forces of the other
// contacts.
double EventIntegrator::parting_acceleration(std::size_t k) {
  step_.evaluate(motion_);
  ContactList<ClosedContact> closed;
  closed.push_back({k, {}});
  for (std::size_t j = 0; j < system_.contacts(); ++j) {
    if (j != k && system_.in_contact(j)) closed.push_back({j, {}});
  }
  const SmoothSystem::Accelerations all =
      system_.accelerations(motion_.t, motion_.y.data(), closed);
  double acceleration = all.b[0];
  for (std::size_t i = 1; i < closed.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(2 * i);
    const Multipliers& force = system_.multipliers(closed[i].index);
    acceleration += all.g(0, at) * force.normal + all.g(0, at + 1) * force.friction;
  }
  return acceleration;
}

void EventIntegrator::release(const ClosedContact& at) {
  observer_.release(motion_, at);
  const ContactParameters& contact = *model_->auxiliary[at.index].contact;
  const double spring = contact.compliance.margin(-at.point.gap, 0.0, 0.0, contact.clearance);
  ContactState free = in_flight(Departure::kRebound);
  free.in_wall = spring > kInWall * margin_scales(at.index).force;
  change_to(at.index, free);
}

// An impact at another contact may throw the shaft off a wall so fast that the wall's damper leaves
// no force. The touch then ends. True if this was the case.
bool EventIntegrator::release_if_unloaded(std::size_t k) {
  if (!model_->auxiliary[k].is_compliant()) return false;
  const ClosedContact at{k, contact_point(*model_, motion_.q(), motion_.v(), k)};
  const double none = kOpen * margin_scales(k).force;
  if (at.point.gap_rate <= 0.0 || *system_.compliant_force(at) >= -none) return false;
  release(at);
  return true;
}

// While a compliant contact sticks, the error of the steps lets its slip drift. A drift against the
// slip that begins would stop it at once.
void EventIntegrator::hold_without_slip(std::size_t k) {
  Closed held = system_.rigid_contacts();
  held.push_back({k, Constraint::Velocity::kSticking});
  project(held);
}

void EventIntegrator::compliant_margin_reached(std::size_t k) {
  step_.evaluate(motion_);
  const ContactState was = system_.state(k);
  const Margins margins = system_.margins(k);
  const MarginScales scales = margin_scales(k);
  const Multipliers force = system_.multipliers(k);
  const ClosedContact at{k, contact_point(*model_, motion_.q(), motion_.v(), k)};
  // If slip and force end together, the contact opens.
  const bool opens =
      margins.force <= parameters_.no_force * scales.force && at.point.gap_rate >= 0.0;
  const PhaseEnd end = opens ? PhaseEnd::kOpens : end_of_phase(was.mode, margins, scales);
  if (was.in_wall) {
    if (end == PhaseEnd::kOpens) return change_to(k, in_flight(Departure::kRebound));
    observer_.begin_touch(motion_, at);
    return decide_one(k, Constraint::Velocity::kAny);
  }
  switch (end) {
    case PhaseEnd::kOpens:
      return release(at);
    case PhaseEnd::kSlipStops:
      return decide_one(k, Constraint::Velocity::kZero);
    case PhaseEnd::kSlipBegins:  // against friction at its limit
      hold_without_slip(k);
      return change_to(k, {ContactMode::kSlide, force.friction > 0.0 ? -1.0 : 1.0});
  }
}

}  // namespace rotorub
