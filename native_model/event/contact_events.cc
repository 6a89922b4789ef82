// Events at the contacts of an event-driven run: impacts, ends of lasting contact, and the
// decisions about what follows.

#include <algorithm>
#include <cmath>

#include "native_model/event/driver.h"
#include "native_model/event/location.h"
#include "native_model/model/dynamics.h"

namespace rotorub {
namespace {

using Velocity = Constraint::Velocity;

constexpr double kNoSpeed = 1e-12;  // relative to the speeds; smaller gap rates or slips count as 0
constexpr double kDrift = 1e-9;     // the same for the slip of a compliant contact that sticks
constexpr double kNoForce = 1e-12;  // relative to the largest force; less counts as 0

}  // namespace

void EventIntegrator::project(const Closed& closed) {
  constraint_.project(motion_.t, motion_.q(), motion_.v(), closed);
}

// Rigid contacts that are in contact, redundant or on their circles; nothing is known about their
// velocities.
EventIntegrator::Closed EventIntegrator::on_circles() const {
  Closed closed;
  for (std::size_t k = 0; k < system_.contacts(); ++k) {
    const auto& contact = model_->auxiliary[k].contact;
    if (!contact || contact->is_compliant()) continue;
    const double gap = contact_point(*model_, motion_.q(), motion_.v(), k).gap;
    if (system_.in_contact(k) || system_.state(k).redundant ||
        is_on_circle(gap, contact->clearance))
      closed.push_back({k, Velocity::kAny});
  }
  return closed;
}

// Decides about contacts on their circles, as at a start. A contact that moves outward has an
// impact; a contact at rest is a lasting contact.
void EventIntegrator::begin_on_circles(const Closed& closed) {
  Closed resting;
  for (const ClosedContact& c : closed_points(*model_, motion_.q(), motion_.v(), closed)) {
    if (c.point.gap_rate < 0.0) return impact(c.index);
    if (c.point.gap_rate <= parameters_.zeno_velocity_threshold) {
      resting.push_back({c.index, Velocity::kAny});
    } else {
      system_.set(c.index, in_flight(Departure::kRebound));
    }
  }
  if (closed.empty()) return;
  project(closed);
  if (!resting.empty()) decide(resting);
}

void EventIntegrator::impact(std::size_t contact) {
  if (model_->auxiliary[contact].is_compliant()) {
    const double speed = -contact_point(*model_, motion_.q(), motion_.v(), contact).gap_rate;
    return begin_touch(contact, model_->auxiliary[contact].contact->compliance.a_of_touch(speed));
  }
  first_touch(contact);
  Closed closed = on_circles();
  // The located contact is closed, whatever its round-off.
  if (std::none_of(closed.begin(), closed.end(),
                   [&](const Constraint::Closed& c) { return c.contact == contact; })) {
    closed.push_back({contact, Velocity::kAny});
  }
  project(closed);
  const auto points = closed_points(*model_, motion_.q(), motion_.v(), closed);
  if (std::none_of(points.begin(), points.end(),
                   [](const ClosedContact& c) { return c.point.gap_rate < 0.0; })) {
    return begin_on_circles(closed);  // the contact grazes
  }
  stiffness_.count_impact();
  const EventImpact::Outcome outcome = impacts_.run(motion_, points, end_);
  if (outcome.status != Status::kOk) {
    return fail(outcome.status, outcome.status == Status::kAmbiguous
                                    ? "the impact laws have several solutions"
                                    : "the impact laws have no solution");
  }
  Closed resting;
  for (const EventImpact::After& after : outcome.contacts) {
    if (after.struck) first_touch(after.contact);
    if (after.rests) {
      resting.push_back({after.contact, after.stuck ? Velocity::kZero : Velocity::kTangential});
    } else if (outcome.is_last) {
      resting.push_back({after.contact, Velocity::kAny});
    } else {
      change_to(after.contact, in_flight(after.departure));
    }
  }
  decide(resting);
}

// Lasting contact ends, or its friction changes.
void EventIntegrator::margin_reached(std::size_t contact) {
  if (model_->auxiliary[contact].is_compliant()) return compliant_margin_reached(contact);
  const ContactMode mode = system_.state(contact).mode;
  step_.evaluate(motion_);
  const Multipliers force = system_.multipliers(contact);
  const MarginScales scales = margin_scales(contact);
  // If force and friction end together, as at every opening of a shaft that does not turn, the
  // contact opens. Otherwise round-off would decide whether it slips or sticks.
  const PhaseEnd end = force.normal <= parameters_.no_force * scales.force
                           ? PhaseEnd::kOpens
                           : end_of_phase(mode, system_.margins(contact), scales);
  const bool slides_off = mode == ContactMode::kSlide && end == PhaseEnd::kOpens;
  Closed closed = system_.rigid_contacts();
  for (Constraint::Closed& c : closed) {
    if (c.contact == contact) c.velocity = slides_off ? Velocity::kTangential : Velocity::kZero;
  }
  // Two contacts at one place open together: the located one and its twin.
  ContactList<std::size_t> opening;
  for (const Constraint::Closed& c : closed) {
    const double share = system_.margins(c.contact).force / margin_scales(c.contact).force;
    if (c.contact == contact || std::abs(share) <= kNoForce) opening.push_back(c.contact);
  }
  project(closed);
  switch (end) {
    case PhaseEnd::kOpens:
      for (const std::size_t k : opening) {
        change_to(k, opening.size() < closed.size() ? redundant_contact(Departure::kLiftOff)
                                                    : in_flight(Departure::kLiftOff));
      }
      return;
    case PhaseEnd::kSlipStops:
      return decide(closed);
    case PhaseEnd::kSlipBegins:  // against the friction at its limit
      return change_to(contact, {ContactMode::kSlide, force.friction > 0.0 ? -1.0 : 1.0});
  }
}

// Decides what these contacts on their circles do from here on, together with all others that last
// or are redundant.
void EventIntegrator::decide(const Closed& resting) {
  Closed all_closed = resting;
  for (std::size_t k = 0; k < system_.contacts(); ++k) {
    if (!system_.in_contact(k) && !system_.state(k).redundant) continue;
    const auto is_named = [k](const Constraint::Closed& c) { return c.contact == k; };
    if (std::any_of(resting.begin(), resting.end(), is_named) || release_if_unloaded(k)) continue;
    all_closed.push_back(
        {k, system_.in_contact(k) ? velocity_of(system_.state(k).mode) : Velocity::kAny});
  }
  decide_all(all_closed);
}

void EventIntegrator::decide_one(std::size_t contact, Velocity velocity) {
  Closed resting;
  resting.push_back({contact, velocity});
  decide(resting);
}

void EventIntegrator::decide_all(const Closed& closed_here) {
  if (closed_here.empty()) return;
  ContactList<ClosedContact> closed;
  for (const Constraint::Closed& c : closed_here) closed.push_back({c.contact, {}});
  SmoothSystem::Accelerations all = system_.accelerations(motion_.t, motion_.y.data(), closed);
  ContactList<double> slips, friction;
  ContactList<std::optional<double>> compliant_force;
  bool settles = false;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const std::size_t k = closed[i].index;
    const ContactPoint& p = closed[i].point;
    const bool is_compliant = model_->auxiliary[k].is_compliant();
    force_scale_[k] = std::max(force_scale_[k], all.scale[at] / all.g(2 * at, 2 * at));
    if (closed_here[i].velocity == Velocity::kAny && !is_compliant) {
      settles = true;
      if (!gap_rate_is_zero(p)) all.b[2 * at] += p.gap_rate / parameters_.shortest_flight;
    }
    const bool sticks = closed_here[i].velocity == Velocity::kZero;
    const bool stops =
        sticks && !is_compliant ? true : slip_is_zero(k, p, sticks ? kDrift : kNoSpeed);
    slips.push_back(stops ? 0.0 : p.slip);
    friction.push_back(model_->auxiliary[k].contact->friction.at(slips[i]));
    std::optional<double> known = system_.compliant_force(closed[i]);
    // At a touch the penetration is round-off, of either sign.
    if (known) known = std::max(*known, 0.0);
    compliant_force.push_back(known);
  }
  const ContactDecisions decided = select_contact_modes(all.g, all.b, all.scale, slips, friction,
                                                        parameters_.no_force, compliant_force);
  if (decided.status != Status::kOk) return fail(decided.status, decided.reason);
  for (std::size_t i = 0; i < closed.size(); ++i) change_to(closed[i].index, decided.next[i]);
  if (settles) settle(closed_here);
}

// Puts lasting contacts on their circles; the others fly, or become redundant where they are.
void EventIntegrator::settle(const Closed& decided) {
  const Closed lasting = system_.rigid_contacts();
  project(lasting);
  for (const ClosedContact& c : closed_points(*model_, motion_.q(), motion_.v(), decided)) {
    const AuxiliaryBearing& bearing = model_->auxiliary[c.index];
    if (system_.in_contact(c.index) || bearing.is_compliant()) continue;
    ContactState state = system_.state(c.index);
    if (c.point.gap > kRedundantGap * bearing.contact->clearance) {
      state = in_flight(Departure::kInside);
    } else if (c.point.gap_rate > 0.0 && !gap_rate_is_zero(c.point)) {
      state = in_flight(Departure::kRebound);
    } else if (!lasting.empty()) {
      state = redundant_contact(Departure::kParting);
    }
    state.redundant_gap = std::min(0.0, c.point.gap);
    system_.set(c.index, state);
  }
}

bool EventIntegrator::gap_rate_is_zero(const ContactPoint& p) const {
  return std::abs(p.gap_rate) <= kNoSpeed * std::max(p.dv.norm(), step_.largest_speed());
}

// share: relative to the speeds. The slip of a shaft that does not turn is its whole speed, so the
// largest speed of the run is the scale.
bool EventIntegrator::slip_is_zero(std::size_t k, const ContactPoint& p, double share) const {
  const double surface =
      std::abs(p.whirl_speed()) + model_->auxiliary[k].contact->radius * std::abs(p.spin);
  return std::abs(p.slip) <= share * std::max(surface, step_.largest_contact_speed(k));
}

void EventIntegrator::change_to(std::size_t k, const ContactState& next) {
  if (next.mode != ContactMode::kFree) first_touch(k);
  if (const auto event = event_between(system_.state(k), next))
    observer_.record(motion_.t, *event, k);
  ContactState state = next;
  if (state.mode != ContactMode::kFree || state.in_wall) {
    state.hunt_crossley = system_.state(k).hunt_crossley;
  }
  system_.set(k, state);
}

void EventIntegrator::first_touch(std::size_t k) {
  if (!std::isfinite(system_.first_touch(k))) system_.first_touch(k, motion_.t);
}

MarginScales EventIntegrator::margin_scales(std::size_t k) const {
  return {force_scale_[k], step_.largest_contact_speed(k)};
}

}  // namespace rotorub
