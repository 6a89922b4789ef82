// What happens at the contacts of an event-driven run: impacts, the ends of lasting contact, and
// what comes next.

#include <algorithm>
#include <cmath>

#include "native_model/dynamics/dynamics.h"
#include "native_model/event/driver.h"

namespace rotorub {
namespace {

constexpr double kOnCircle = 1e-12;  // of the clearance: a gap that counts as 0

}  // namespace

// A start on the circle: moving outward it is an impact, at rest lasting contact.
void EventIntegrator::begin_on_circles() {
  const std::span<ClosedContact> touching = closed_now();
  if (touching.empty()) return;
  std::array<Constraint::Closed, kMaxContacts> on_circle{};
  std::array<Resting, kMaxContacts> resting{};
  std::size_t rests = 0;
  for (std::size_t i = 0; i < touching.size(); ++i) {
    const std::size_t k = touching[i].index;
    if (touching[i].point.gap_rate < 0.0) return impact(k);
    const bool rest = touching[i].point.gap_rate <= parameters_.zeno_velocity_threshold;
    on_circle[i] = {k, rest ? Constraint::Velocity::kAlong : Constraint::Velocity::kKept};
    if (rest) {
      resting[rests++] = {k, false};
    } else {
      phase_.set(k, {Mode::kFree, 1.0, Departure::kRebound});
    }
  }
  constraint_.project(motion_,
                      std::span<const Constraint::Closed>(on_circle).first(touching.size()));
  if (rests > 0) decide(std::span(resting).first(rests), Departure::kParting);
}

std::span<ClosedContact> EventIntegrator::closed_now() {
  std::size_t count = 0;
  for (std::size_t k = 0; k < phase_.contacts(); ++k) {
    const auto& contact = model_->auxiliary[k].contact;
    if (!contact) continue;
    const ContactPoint point = contact_point(*model_, motion_.q(), motion_.v(), k);
    if (phase_.in_contact(k) || point.gap <= kOnCircle * contact->clearance)
      closed_[count++] = {k, point};
  }
  return std::span(closed_).first(count);
}

std::span<const Constraint::Closed> EventIntegrator::constrained() {
  std::size_t count = 0;
  for (std::size_t k = 0; k < phase_.contacts(); ++k) {
    if (!phase_.in_contact(k)) continue;
    const bool sticks = phase_.state(k).mode == Mode::kStick;
    constrained_[count++] = {k,
                             sticks ? Constraint::Velocity::kStuck : Constraint::Velocity::kAlong};
  }
  return std::span(constrained_).first(count);
}

void EventIntegrator::impact(std::size_t contact) {
  first_touch(contact);
  std::array<Constraint::Closed, kMaxContacts> kept{};
  std::size_t count = 0;
  for (const ClosedContact& c : closed_now())
    kept[count++] = {c.index, Constraint::Velocity::kKept};
  // The located one is closed, whatever round-off says.
  const auto last = kept.begin() + static_cast<std::ptrdiff_t>(count);
  if (std::none_of(kept.begin(), last,
                   [&](const Constraint::Closed& c) { return c.contact == contact; })) {
    kept[count++] = {contact, Constraint::Velocity::kKept};
  }
  constraint_.project(motion_, std::span<const Constraint::Closed>(kept).first(count));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = kept[i].contact;
    closed_[i] = {k, contact_point(*model_, motion_.q(), motion_.v(), k)};
  }
  const std::span<const ClosedContact> closed = std::span(closed_).first(count);
  const bool closes = std::any_of(closed.begin(), closed.end(),
                                  [](const ClosedContact& c) { return c.point.gap_rate < 0.0; });
  if (!closes) return begin_on_circles();  // it grazes
  if (impact_.rebounds(motion_, closed.front().point))
    return impact_over_time(closed.front().point);
  const CoupledImpactOutcome outcome =
      coupled_impact(*model_, parameters_, closed, motion_, constraint_, observer_);
  if (fails(outcome.status)) return;
  std::array<Resting, kMaxContacts> resting{};
  std::array<Constraint::Closed, kMaxContacts> along{};
  std::size_t rests = 0;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    const std::size_t k = closed[i].index;
    if (outcome.struck[i]) first_touch(k);
    if (outcome.rests[i]) {
      along[rests] = {
          k, outcome.stuck[i] ? Constraint::Velocity::kStuck : Constraint::Velocity::kAlong};
      resting[rests++] = {k, outcome.stuck[i]};
    } else {
      change_to(k, {Mode::kFree, 1.0, Departure::kRebound});
    }
  }
  if (rests == 0) return;
  constraint_.project(motion_, std::span<const Constraint::Closed>(along).first(rests));
  decide(std::span(resting).first(rests), Departure::kParting);
}

void EventIntegrator::impact_over_time(const ContactPoint& touch) {
  const EventImpact::Outcome outcome = impact_.run(motion_, touch, end_);
  if (fails(outcome.status)) return;
  switch (outcome.after) {
    case EventImpact::Outcome::kParts:
      return change_to(0, {Mode::kFree, 1.0, Departure::kRebound});
    case EventImpact::Outcome::kInside:
      return change_to(0, {Mode::kFree, 1.0, Departure::kInside});
    case EventImpact::Outcome::kRests:
      return decide_one({0, false}, Departure::kParting);
  }
}

bool EventIntegrator::fails(Status impact) {
  if (impact == Status::kNoSolution) fail(impact, "the impact laws have no solution");
  if (impact == Status::kAmbiguous) fail(impact, "the impact laws have several solutions");
  return impact == Status::kNoSolution || impact == Status::kAmbiguous;
}

// Lasting contact ends, or its friction changes.
void EventIntegrator::margin_reached(std::size_t k) {
  const Mode mode = phase_.state(k).mode;
  step_.evaluate(motion_);
  const Multipliers force = phase_.multipliers(k);
  const PhaseEnd end = end_of_phase(mode, phase_.margins(k), margin_scales(k));
  const bool slides_off = mode == Mode::kSlide && end == PhaseEnd::kOpens;
  const std::span<const Constraint::Closed> others = constrained();
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (others[i].contact != k) continue;
    constrained_[i].velocity =
        slides_off ? Constraint::Velocity::kAlong : Constraint::Velocity::kStuck;
  }
  constraint_.project(motion_, others);
  switch (end) {
    case PhaseEnd::kOpens:
      return change_to(k, {Mode::kFree, 1.0, Departure::kLiftOff});
    case PhaseEnd::kSlipStops: {
      std::array<Resting, kMaxContacts> resting{};
      for (std::size_t i = 0; i < others.size(); ++i) {
        const std::size_t other = others[i].contact;
        resting[i] = {other, other == k || phase_.state(other).mode == Mode::kStick};
      }
      return decide(std::span(resting).first(others.size()), Departure::kParting);
    }
    case PhaseEnd::kSlipBegins:  // against friction at its limit
      return change_to(k, {Mode::kSlide, force.friction > 0.0 ? -1.0 : 1.0});
  }
}

void EventIntegrator::decide_one(const Resting& resting, Departure parting) {
  const std::size_t k = resting.contact;
  const Phase::Contact c = phase_.contact(k, motion_.t, motion_.y.data());
  force_scale_[k] = std::max(force_scale_[k], c.b.scale / c.b.g.nn);
  const double slip = resting.slip_is_zero ? 0.0 : c.point.slip;
  const ContactDecision d = select_contact_mode(
      c.b, slip, model_->auxiliary[k].contact->friction.at(slip), parameters_.no_force, parting);
  if (d.status != Status::kOk) return fail(d.status, d.reason);
  change_to(k, d.next);
}

void EventIntegrator::decide(std::span<const Resting> resting, Departure parting) {
  if (resting.size() == 1) return decide_one(resting.front(), parting);
  const std::size_t n = resting.size();
  std::array<double, kMaxContacts> slips{}, friction{};
  for (std::size_t i = 0; i < n; ++i) closed_[i].index = resting[i].contact;
  const std::span<ClosedContact> closed = std::span(closed_).first(n);
  const Phase::Accelerations all = phase_.accelerations(motion_.t, motion_.y.data(), closed);
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const std::size_t k = closed[i].index;
    force_scale_[k] = std::max(force_scale_[k], all.scale[at] / all.g(2 * at, 2 * at));
    slips[i] = resting[i].slip_is_zero ? 0.0 : closed[i].point.slip;
    friction[i] = model_->auxiliary[k].contact->friction.at(slips[i]);
  }
  const ContactDecisions decisions =
      select_contact_modes(all.g, all.b, all.scale, std::span(slips).first(n),
                           std::span(friction).first(n), parameters_.no_force, parting);
  if (decisions[0].status != Status::kOk) return fail(decisions[0].status, decisions[0].reason);
  for (std::size_t i = 0; i < n; ++i) change_to(resting[i].contact, decisions[i].next);
}

void EventIntegrator::change_to(std::size_t k, const ContactState& next) {
  if (next.mode != Mode::kFree) first_touch(k);
  if (const auto event = event_between(phase_.state(k), next))
    observer_.record(motion_.t, *event, k);
  phase_.set(k, next);
}

void EventIntegrator::first_touch(std::size_t k) {
  if (!std::isfinite(phase_.first_touch(k))) phase_.first_touch(k, motion_.t);
}

MarginScales EventIntegrator::margin_scales(std::size_t k) const {
  return {force_scale_[k], step_.largest_contact_speed(k)};
}

}  // namespace rotorub
