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
      sampled_(model) {}

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
  phase_.set({});
  phase_.first_touch(kInfinity);
  phase_.hold({0.0, 0.0});
  phase_.show({});
  sampled_.clear();
  step_.begin(motion_, std::min(kFirstStep, end_ - start.t));
  stiffness_.begin();
  observer_.begin(motion_, recorder);
  force_scale_ = kLeastForce;
  stalled_ = 0;
  last_event_ = -1.0;
  booked_ = start.t;
  sample_controller();
  if (model_->contact) begin_on_circle(contact_point(*model_, motion_.q(), motion_.v()));
  observer_.started(motion_);
  step_.restart(motion_);
}

// A start on the circle: moving outward it is an impact, at rest lasting contact.
void EventIntegrator::begin_on_circle(const ContactPoint& p) {
  if (p.gap > kOnCircle * model_->contact->clearance) return;
  if (p.gap_rate < 0.0) {
    impact();
  } else if (p.gap_rate <= parameters_.zeno_velocity_threshold) {
    constraint_.project(motion_, Constraint::Velocity::kAlong);
    decide(false, Departure::kParting);
  } else {
    constraint_.project(motion_, Constraint::Velocity::kKept);
    phase_.set({Mode::kFree, 1.0, Departure::kRebound});
  }
}

// One step, up to `limit` or to the event in it, and what happens there.
void EventIntegrator::advance(double limit) {
  if (!step_.advance(motion_, limit)) return fail_step();
  ++result_.steps;
  if (const auto why = stiffness_.look(step_.end_time(), end_, step_)) {
    return fail(Status::kStepTooLarge, *why);
  }

  std::optional<double> event;
  if (phase_.in_contact()) {
    force_scale_ = std::max(force_scale_, std::abs(phase_.multipliers().normal));
    event = locate_margin(step_, phase_.state().mode, margin_scales(), parameters_);
  } else if (model_->contact) {
    event = locate_contact(*model_, step_, motion_, phase_.state().departure);
  }
  const std::optional<double> loss = locate_loss(*model_, step_, event.value_or(1.0));
  if (loss) event = loss;

  const double now = event ? std::min(step_.end_time(), step_.time(*event)) : step_.end_time();
  observer_.watch(motion_, step_, &constraint_, now);
  if (event) {
    step_.dense(*event, motion_.y.data());
  } else {
    step_.accept(motion_);
  }
  motion_.t = now;

  if (loss) {
    const auto reason = out_of_range(*model_, motion_.q());
    fail(Status::kOutOfRange, reason.value_or("rotor or ring left its range"));
  } else if (event) {
    phase_.in_contact() ? margin_reached() : impact();
    step_.restart(motion_);
    count_event();
  } else if (phase_.in_contact()) {
    constraint_.project(motion_, phase_.state().mode == Mode::kStick
                                     ? Constraint::Velocity::kStuck
                                     : Constraint::Velocity::kAlong);
  } else {
    phase_.set({});
  }
  step_.meet(motion_);
  observer_.meet_energy(motion_);
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
  sample_controller();
  const Departure departure = phase_.state().departure;
  const bool just_left = departure == Departure::kParting || departure == Departure::kLiftOff;
  if (phase_.in_contact() || just_left) {
    decide(phase_.state().mode == Mode::kStick, Departure::kParting);
  }
  step_.restart(motion_);
}

void EventIntegrator::sample_controller() {
  if (!schedule_.sample_due(motion_.t)) return;
  const double *q = motion_.q(), *v = motion_.v();
  if (!model_->loop) return phase_.hold(control_command(*model_, motion_.t, q, v));
  const Eigen::Vector2d held = phase_.command(motion_.t, motion_.y.data());
  phase_.hold(sampled_.take(motion_.t, q, v, held));
  phase_.show(sampled_.outputs());
  if (sampled_.failure().empty() || result_.status != Status::kOk) return;
  result_.status = Status::kControllerFailed;
  result_.message = sampled_.failure();  // with its time
}

void EventIntegrator::impact() {
  first_touch();
  constraint_.project(motion_, Constraint::Velocity::kKept);
  const ContactPoint touch = contact_point(*model_, motion_.q(), motion_.v());
  if (touch.gap_rate >= 0.0) {  // it grazes
    constraint_.project(motion_, Constraint::Velocity::kAlong);
    return decide(false, Departure::kParting);
  }
  const EventImpact::Outcome outcome = impact_.run(motion_, touch, end_);
  if (outcome.status == Status::kNoSolution) {
    return fail(Status::kNoSolution, "the impact laws have no solution");
  }
  if (outcome.status == Status::kAmbiguous) {
    return fail(Status::kAmbiguous, "the impact laws have several solutions");
  }
  switch (outcome.after) {
    case EventImpact::Outcome::kParts:
      return change_to({Mode::kFree, 1.0, Departure::kRebound});
    case EventImpact::Outcome::kInside:
      return change_to({Mode::kFree, 1.0, Departure::kInside});
    case EventImpact::Outcome::kRests:
      return decide(outcome.stuck, Departure::kParting);
  }
}

// Lasting contact ends, or its friction changes.
void EventIntegrator::margin_reached() {
  const Mode mode = phase_.state().mode;
  step_.evaluate(motion_);
  const Multipliers force = phase_.multipliers();
  const PhaseEnd end = end_of_phase(mode, phase_.margins(), margin_scales());
  constraint_.project(motion_, mode == Mode::kSlide && end == PhaseEnd::kOpens
                                   ? Constraint::Velocity::kAlong
                                   : Constraint::Velocity::kStuck);
  switch (end) {
    case PhaseEnd::kOpens:
      return change_to({Mode::kFree, 1.0, Departure::kLiftOff});
    case PhaseEnd::kSlipStops:
      return decide(true, Departure::kParting);
    case PhaseEnd::kSlipBegins:  // against friction at its limit
      return change_to({Mode::kSlide, force.friction > 0.0 ? -1.0 : 1.0});
  }
}

// On the circle with gap rate 0.
void EventIntegrator::decide(bool slip_is_zero, Departure parting) {
  const Phase::Contact c = phase_.contact(motion_.t, motion_.y.data());
  force_scale_ = std::max(force_scale_, c.b.scale / c.b.g.nn);
  const ContactDecision d =
      select_contact_mode(c.b, slip_is_zero ? 0.0 : c.point.slip, model_->contact->friction,
                          parameters_.no_force, parting);
  if (d.status != Status::kOk) return fail(d.status, d.reason);
  change_to(d.next);
}

void EventIntegrator::change_to(const ContactState& next) {
  if (next.mode != Mode::kFree) first_touch();
  if (const auto event = event_between(phase_.state(), next)) observer_.record(motion_.t, *event);
  phase_.set(next);
}

void EventIntegrator::first_touch() {
  if (!std::isfinite(phase_.first_touch())) phase_.first_touch(motion_.t);
}

MarginScales EventIntegrator::margin_scales() const {
  return {force_scale_, step_.largest_contact_speed()};
}

// Sliding whose G_NN - mu s G_NT runs into 0 needs forces without bound.
void EventIntegrator::fail_step() {
  if (phase_.state().mode == Mode::kSlide) {
    const Delassus g = phase_.contact(motion_.t, motion_.y.data()).b.g;
    const double mu_sign = model_->contact->friction * phase_.state().slip_sign;
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
  result_.message = why + " at t = " + std::to_string(motion_.t) + " s, " +
                    to_string(phase_.state().mode) + " contact state";
}

}  // namespace rotorub
