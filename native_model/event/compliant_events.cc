// What happens at contacts that give (contact/compliance.h): touch, release, stick and slip.

#include "native_model/dynamics/dynamics.h"
#include "native_model/event/driver.h"

namespace rotorub {
namespace {

constexpr double kOpen = 1e-12;   // of the largest force: one that counts as 0
constexpr double kInWall = 1e-9;  // of the largest spring force: a depth that is one

}  // namespace

// A start in the wall is a contact that begins at rest, one on the circle a touch.
void EventIntegrator::begin_in_walls() {
  for (std::size_t k = 0; k < phase_.contacts(); ++k) {
    if (!model_->auxiliary[k].gives()) continue;
    const ContactPoint p = contact_point(*model_, motion_.q(), motion_.v(), k);
    const double round_off = 1e-12 * model_->auxiliary[k].contact->clearance;
    if (p.gap < -round_off) {
      press(k, 0.0);
    } else if (p.gap <= round_off && p.gap_rate <= 0.0) {
      press(k, -p.gap_rate);
    }
  }
}

// From here on the contact presses, by the a of a touch at this speed, m/s. Its friction is decided
// with that of all others.
void EventIntegrator::press(std::size_t k, double speed) {
  first_touch(k);
  ContactState state;
  state.hunt_crossley = model_->auxiliary[k].contact->compliance.a_of_touch(speed);
  state.in_wall = true;
  phase_.set(k, state);
  // One that touches without speed may part again at once.
  ClosedContact touch{k, {}};
  const Phase::Accelerations free =
      phase_.accelerations(motion_.t, motion_.y.data(), std::span(&touch, 1));
  if (touch.point.gap >= 0.0 && touch.point.gap_rate >= 0.0 && free.b[0] >= 0.0) {
    return phase_.set(k, in_flight(Departure::kParting));
  }
  observer_.press(motion_, touch);
  press_on(k);
}

void EventIntegrator::press_on(std::size_t k) {
  Closed touching;
  touching.push_back({k, Constraint::Velocity::kKept});
  decide(touching);
}

void EventIntegrator::release(const ClosedContact& at) {
  observer_.release(motion_, at);
  const ContactParameters& contact = *model_->auxiliary[at.index].contact;
  const double spring = contact.compliance.margin(-at.point.gap, 0.0, 0.0, contact.clearance);
  ContactState free = in_flight(Departure::kRebound);
  free.in_wall = spring > kInWall * margin_scales(at.index).force;
  change_to(at.index, free);
}

// An impact at another contact may throw the shaft off a wall faster than its damper lets it press.
bool EventIntegrator::no_longer_presses(std::size_t k) {
  if (!model_->auxiliary[k].gives()) return false;
  const ClosedContact at{k, contact_point(*model_, motion_.q(), motion_.v(), k)};
  const double none = kOpen * margin_scales(k).force;
  if (at.point.gap_rate <= 0.0 || *phase_.pressing(at) >= -none) return false;
  release(at);
  return true;
}

void EventIntegrator::press_margin_reached(std::size_t k) {
  step_.evaluate(motion_);
  const ContactState was = phase_.state(k);
  const Margins margins = phase_.margins(k);
  const MarginScales scales = margin_scales(k);
  const Multipliers force = phase_.multipliers(k);
  const ClosedContact at{k, contact_point(*model_, motion_.q(), motion_.v(), k)};
  // Where slip and force end together it opens.
  const bool opens =
      margins.force <= parameters_.no_force * scales.force && at.point.gap_rate >= 0.0;
  const PhaseEnd end = opens ? PhaseEnd::kOpens : end_of_phase(was.mode, margins, scales);
  if (was.in_wall) {
    if (end == PhaseEnd::kOpens) return change_to(k, in_flight(Departure::kRebound));
    observer_.press(motion_, at);
    return press_on(k);
  }
  switch (end) {
    case PhaseEnd::kOpens:
      return release(at);
    case PhaseEnd::kSlipStops: {
      Closed stopped;
      stopped.push_back({k, Constraint::Velocity::kStuck});
      return decide(stopped);
    }
    case PhaseEnd::kSlipBegins:  // against friction at its limit
      return change_to(k, {Mode::kSlide, force.friction > 0.0 ? -1.0 : 1.0});
  }
}

}  // namespace rotorub
