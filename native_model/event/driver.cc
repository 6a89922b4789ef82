#include "native_model/event/driver.h"

#include <algorithm>
#include <cmath>

#include "native_model/event/location.h"
#include "native_model/system/actuation.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/trajectory/range_check.h"

namespace rotorub {
namespace {

constexpr double kFirstStep = 1e-6;     // s; the step size finds itself from there
constexpr double kOnCircle = 1e-12;     // of the clearance: a gap of the start that is none
constexpr double kLeastForce = 1e-300;  // N, a scale that is not 0

}  // namespace

EventIntegrator::EventIntegrator(const Model& model, const EventParameters& parameters)
    : model_(&model),
      parameters_(parameters),
      motion_(model),
      schedule_(model),
      phase_(model),
      step_(model, parameters_, phase_),
      stiffness_(model, parameters_),
      constraint_(model),
      observer_(model, parameters_, phase_),
      impact_(model, parameters_, phase_, constraint_, observer_),
      force_scale_(model.auxiliary.size(), kLeastForce) {
  for (std::size_t k = 0; k < model.auxiliary.size(); ++k) sampled_.emplace_back(model, k);
}

EventIntegrator::Result EventIntegrator::run(const State& start, double end, Recorder& recorder,
                                             const std::function<void(double)>& progress,
                                             const std::atomic<bool>* interrupt) {
  end_ = end;
  begin(start, recorder);
  std::int64_t ticks = 0;
  while (motion_.t < end_ && result_.status == Status::kOk) {
    const double limit = schedule_.next(motion_.t);
    advance(limit);
    if (result_.status != Status::kOk) break;
    if (motion_.t >= limit && motion_.t < end_) arrive_at_break();  // also one within an impact
    observer_.arrive(motion_);
    if ((ticks++ & 0xff) != 0) continue;
    if (progress) progress(motion_.t / end_);
    if (interrupt && interrupt->load(std::memory_order_relaxed)) {
      fail(Status::kInterrupted, "interrupted");
    }
  }
  book_switches();
  result_.end = motion_.t;
  result_.rejected = step_.rejected();
  observer_.finish(motion_);
  return result_;
}

void EventIntegrator::begin(const State& start, Recorder& recorder) {
  result_ = {};
  schedule_.begin(start.t, end_);
  motion_.begin(start);
  for (std::size_t k = 0; k < phase_.contacts(); ++k) {
    phase_.set(k, {});
    phase_.first_touch(k, kInfinity);
    phase_.hold(k, {0.0, 0.0});
    phase_.show(k, {});
    sampled_[k].clear();
    force_scale_[k] = kLeastForce;
  }
  step_.begin(motion_, std::min(kFirstStep, end_ - start.t));
  stiffness_.begin();
  observer_.begin(motion_, recorder);
  stalled_ = 0;
  last_event_ = -1.0;
  booked_ = start.t;
  sample_controllers();
  begin_on_circles();
  observer_.started(motion_);
  step_.restart(motion_);
}

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
  constraint_.project(motion_, std::span<const Constraint::Closed>(on_circle).first(touching.size()));
  if (rests > 0) decide(std::span(resting).first(rests), Departure::kParting);
}

// One step, up to `limit` or to the event in it, and what happens there.
void EventIntegrator::advance(double limit) {
  if (!step_.advance(motion_, limit)) return fail_step();
  ++result_.steps;
  if (const auto why = stiffness_.look(step_.end_time(), end_, step_)) {
    return fail(Status::kStepTooLarge, *why);
  }

  std::optional<Found> event = find_event();
  if (const auto loss = locate_loss(*model_, step_, event ? event->theta : 1.0)) {
    return lose(*loss);
  }
  const double now = event ? std::min(step_.end_time(), step_.time(event->theta)) : step_.end_time();
  move_to(now, event ? std::optional(event->theta) : std::nullopt);
  if (event) {
    phase_.in_contact(event->contact) ? margin_reached(event->contact) : impact(event->contact);
    step_.restart(motion_);
    count_event();
  } else {
    constraint_.project(motion_, constrained());
  }
  step_.meet(motion_);
  observer_.meet_energy(motion_);
}

// By the step, or a part of it.
void EventIntegrator::move_to(double now, std::optional<double> theta) {
  observer_.watch(motion_, step_, &constraint_, now);
  if (theta) {
    step_.dense(*theta, motion_.y.data());
  } else {
    step_.accept(motion_);
  }
  // How a flight began matters no more once it has.
  if (now > motion_.t) {
    for (std::size_t k = 0; k < phase_.contacts(); ++k) {
      if (!phase_.in_contact(k)) phase_.set(k, {});
    }
  }
  motion_.t = now;
}

// Rotor or ring leaves its range.
void EventIntegrator::lose(double theta) {
  move_to(std::min(step_.end_time(), step_.time(theta)), theta);
  const auto reason = out_of_range(*model_, motion_.q());
  fail(Status::kOutOfRange, reason.value_or("rotor or ring left its range"));
  step_.meet(motion_);
  observer_.meet_energy(motion_);
}

// The first contact that closes, or margin that is crossed.
std::optional<EventIntegrator::Found> EventIntegrator::find_event() {
  std::optional<Found> first;
  for (std::size_t k = 0; k < phase_.contacts(); ++k) {
    if (!model_->auxiliary[k].contact) continue;
    std::optional<double> theta;
    if (phase_.in_contact(k)) {
      force_scale_[k] = std::max(force_scale_[k], std::abs(phase_.multipliers(k).normal));
      theta = locate_margin(k, step_, phase_.state(k).mode, margin_scales(k), parameters_);
    } else {
      theta = locate_contact(*model_, k, step_, motion_, phase_.state(k).departure);
    }
    if (theta && (!first || *theta < first->theta)) first = Found{*theta, k};
  }
  return first;
}

std::span<ClosedContact> EventIntegrator::closed_now() {
  std::size_t count = 0;
  for (std::size_t k = 0; k < phase_.contacts(); ++k) {
    const auto& contact = model_->auxiliary[k].contact;
    if (!contact) continue;
    const ContactPoint point = contact_point(*model_, motion_.q(), motion_.v(), k);
    if (phase_.in_contact(k) || point.gap <= kOnCircle * contact->clearance) closed_[count++] = {k, point};
  }
  return std::span(closed_).first(count);
}

std::span<const Constraint::Closed> EventIntegrator::constrained() {
  std::size_t count = 0;
  for (std::size_t k = 0; k < phase_.contacts(); ++k) {
    if (!phase_.in_contact(k)) continue;
    const bool sticks = phase_.state(k).mode == Mode::kStick;
    constrained_[count++] = {k, sticks ? Constraint::Velocity::kStuck : Constraint::Velocity::kAlong};
  }
  return std::span(constrained_).first(count);
}

void EventIntegrator::count_event() {
  const double t = motion_.t;
  if (t - last_event_ > 1e-15 * std::max(1e-3, t)) stalled_ = 0;
  last_event_ = t;
  if (++stalled_ > parameters_.stall_limit) fail(Status::kNoSolution, "events without end");
}

void EventIntegrator::book_switches() {
  motion_.integral(kExternalWork) +=
      switching_work(*model_, booked_, motion_.t, motion_.q(), motion_.v());
  booked_ = motion_.t;
}

// Loads or the command jump here: lasting contact, and contact lost this very instant, is decided
// anew.
void EventIntegrator::arrive_at_break() {
  book_switches();
  sample_controllers();
  std::array<Resting, kMaxContacts> resting{};
  std::size_t count = 0;
  for (std::size_t k = 0; k < phase_.contacts(); ++k) {
    const ContactState& state = phase_.state(k);
    const bool just_left = state.departure == Departure::kParting || state.departure == Departure::kLiftOff;
    if (phase_.in_contact(k) || just_left) resting[count++] = {k, state.mode == Mode::kStick};
  }
  if (count > 0) decide(std::span(resting).first(count), Departure::kParting);
  step_.restart(motion_);
}

void EventIntegrator::sample_controllers() {
  const double *q = motion_.q(), *v = motion_.v();
  for (std::size_t k = 0; k < phase_.contacts(); ++k) {
    if (!schedule_.sample_due(k, motion_.t)) continue;
    if (!model_->auxiliary[k].loop) {
      phase_.hold(k, control_command(*model_, motion_.t, q, v, k));
      continue;
    }
    const Eigen::Vector2d held = phase_.command(k, motion_.t, motion_.y.data());
    phase_.hold(k, sampled_[k].take(motion_.t, q, v, held));
    phase_.show(k, sampled_[k].outputs());
    if (sampled_[k].failure().empty() || result_.status != Status::kOk) continue;
    result_.status = Status::kControllerFailed;
    result_.message = sampled_[k].failure();  // with its time
  }
}

void EventIntegrator::impact(std::size_t contact) {
  first_touch(contact);
  std::array<Constraint::Closed, kMaxContacts> kept{};
  std::size_t count = 0;
  for (const ClosedContact& c : closed_now()) kept[count++] = {c.index, Constraint::Velocity::kKept};
  // The located one is closed, whatever round-off says.
  const auto last = kept.begin() + static_cast<std::ptrdiff_t>(count);
  if (std::none_of(kept.begin(), last, [&](const Constraint::Closed& c) { return c.contact == contact; })) {
    kept[count++] = {contact, Constraint::Velocity::kKept};
  }
  constraint_.project(motion_, std::span<const Constraint::Closed>(kept).first(count));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = kept[i].contact;
    closed_[i] = {k, contact_point(*model_, motion_.q(), motion_.v(), k)};
  }
  const std::span<const ClosedContact> closed = std::span(closed_).first(count);
  count == 1 ? impact_of_one(closed.front()) : impact_of_several(closed);
}

void EventIntegrator::impact_of_one(const ClosedContact& touch) {
  const std::size_t k = touch.index;
  if (touch.point.gap_rate >= 0.0) {  // it grazes
    const Constraint::Closed along{k, Constraint::Velocity::kAlong};
    constraint_.project(motion_, std::span(&along, 1));
    return decide_one({k, false}, Departure::kParting);
  }
  const EventImpact::Outcome outcome = impact_.run(k, motion_, touch.point, end_);
  if (fails(outcome.status)) return;
  switch (outcome.after) {
    case EventImpact::Outcome::kParts:
      return change_to(k, {Mode::kFree, 1.0, Departure::kRebound});
    case EventImpact::Outcome::kInside:
      return change_to(k, {Mode::kFree, 1.0, Departure::kInside});
    case EventImpact::Outcome::kRests:
      return decide_one({k, outcome.stuck}, Departure::kParting);
  }
}

void EventIntegrator::impact_of_several(std::span<const ClosedContact> closed) {
  const bool closes = std::any_of(closed.begin(), closed.end(),
                                  [](const ClosedContact& c) { return c.point.gap_rate < 0.0; });
  if (!closes) return begin_on_circles();  // one grazes
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
      along[rests] = {k, outcome.stuck[i] ? Constraint::Velocity::kStuck : Constraint::Velocity::kAlong};
      resting[rests++] = {k, outcome.stuck[i]};
    } else {
      change_to(k, {Mode::kFree, 1.0, Departure::kRebound});
    }
  }
  if (rests == 0) return;
  constraint_.project(motion_, std::span<const Constraint::Closed>(along).first(rests));
  decide(std::span(resting).first(rests), Departure::kParting);
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
    constrained_[i].velocity = slides_off ? Constraint::Velocity::kAlong : Constraint::Velocity::kStuck;
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
  const ContactDecision d = select_contact_mode(c.b, resting.slip_is_zero ? 0.0 : c.point.slip,
                                                model_->auxiliary[k].contact->friction,
                                                parameters_.no_force, parting);
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
    friction[i] = model_->auxiliary[k].contact->friction;
  }
  const ContactDecisions decisions =
      select_contact_modes(all.g, all.b, all.scale, std::span(slips).first(n),
                           std::span(friction).first(n), parameters_.no_force, parting);
  if (decisions[0].status != Status::kOk) return fail(decisions[0].status, decisions[0].reason);
  for (std::size_t i = 0; i < n; ++i) change_to(resting[i].contact, decisions[i].next);
}

void EventIntegrator::change_to(std::size_t k, const ContactState& next) {
  if (next.mode != Mode::kFree) first_touch(k);
  if (const auto event = event_between(phase_.state(k), next)) observer_.record(motion_.t, *event, k);
  phase_.set(k, next);
}

void EventIntegrator::first_touch(std::size_t k) {
  if (!std::isfinite(phase_.first_touch(k))) phase_.first_touch(k, motion_.t);
}

MarginScales EventIntegrator::margin_scales(std::size_t k) const {
  return {force_scale_[k], step_.largest_contact_speed(k)};
}

// Sliding whose G_NN - mu s G_NT runs into 0 needs forces without bound.
void EventIntegrator::fail_step() {
  for (std::size_t k = 0; k < phase_.contacts(); ++k) {
    if (phase_.state(k).mode != Mode::kSlide) continue;
    const Delassus g = phase_.contact(k, motion_.t, motion_.y.data()).b.g;
    const double mu_sign = model_->auxiliary[k].contact->friction * phase_.state(k).slip_sign;
    if (std::abs(carried(g, mu_sign)) < 1e-3 * g.nn) {
      return fail(Status::kNoSolution,
                  "frictional jamming (Painleve): mu |G_NT| reaches G_NN, and the contact forces "
                  "grow without bound");
    }
  }
  fail(Status::kDiverged, "no step is small enough: the state is no longer smooth or finite");
}

void EventIntegrator::fail(Status status, const std::string& why) {
  if (result_.status != Status::kOk) return;
  result_.status = status;
  result_.message = why + " at t = " + std::to_string(motion_.t) + " s, ";
  for (std::size_t k = 0; k < phase_.contacts(); ++k) {
    result_.message += (k > 0 ? ", " : "") + std::string(to_string(phase_.state(k).mode));
  }
  result_.message += " contact state";
}

}  // namespace rotorub
