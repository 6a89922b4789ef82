#include "native_model/event/driver.h"

#include <algorithm>
#include <cmath>

#include "native_model/event/location.h"
#include "native_model/model/actuation.h"
#include "native_model/model/control_states.h"
#include "native_model/model/dynamics.h"
#include "native_model/model/sampled_feedback.h"
#include "native_model/trajectory/range_check.h"

namespace rotorub {
namespace {

constexpr double kFirstStep = 1e-6;     // s; the step size control continues from there
constexpr double kLeastForce = 1e-300;  // N, a scale other than 0

}  // namespace

EventIntegrator::EventIntegrator(const Model& model, const EventParameters& parameters)
    : model_(&model),
      parameters_(parameters),
      motion_(model),
      schedule_(model),
      system_(model),
      step_(model, parameters_, system_),
      stiffness_(model, parameters_),
      constraint_(model),
      observer_(model, parameters_, system_),
      impacts_(model, parameters_, system_, constraint_, observer_),
      force_scale_(model.auxiliary.size(), kLeastForce) {
  for (std::size_t k = 0; k < model.auxiliary.size(); ++k) sampled_.emplace_back(model, k);
}

RunEnd EventIntegrator::run(const State& start, double end, Recorder& recorder,
                            const std::function<void(double)>& progress,
                            const std::atomic<bool>* interrupt) {
  begin(start, end, recorder);
  std::int64_t ticks = 0;
  while (compute_stretch()) {
    pass();
    if (result_.status != Status::kOk) continue;
    // At every step, because a controller may take long.
    if (interrupt && interrupt->load(std::memory_order_relaxed)) {
      fail(Status::kInterrupted, "interrupted");
    }
    if ((ticks++ & 0xff) == 0 && progress) progress(motion_.t / end_);
  }
  count_switching_work();
  result_.end = motion_.t;
  observer_.finish(motion_);
  return result_;
}

void EventIntegrator::begin(const State& start, double end, Recorder& recorder) {
  end_ = end;
  stretch_ = {};
  result_ = {};
  schedule_.begin(start.t, end_);
  motion_.begin(start);
  set_control_clock(*model_, start.t, motion_.v());
  for (std::size_t k = 0; k < system_.contacts(); ++k) {
    system_.set(k, {});
    system_.first_touch(k, kInfinity);
    system_.hold_command(k, {0.0, 0.0});
    system_.set_outputs(k, {});
    sampled_[k].clear();
    force_scale_[k] = kLeastForce;
  }
  step_.begin(motion_, std::min(kFirstStep, end_ - start.t));
  stiffness_.begin();
  observer_.begin(motion_, recorder);
  stalled_ = 0;
  last_event_ = -1.0;
  switching_work_until_ = start.t;
  sample_controllers();
  begin_in_walls();
  begin_on_circles(on_circles());
  observer_.started(motion_);
  step_.restart(motion_);
}

// Takes one step, up to a break or to the event in it.
bool EventIntegrator::compute_stretch() {
  if (stretch_.known) return true;
  if (motion_.t >= end_ || result_.status != Status::kOk) return false;
  stretch_ = {};
  stretch_.limit = schedule_.next(motion_.t);
  if (!step_.advance(motion_, stretch_.limit)) {
    fail_step();
    return false;
  }
  ++result_.steps;
  if (const auto why = stiffness_.check(motion_.t, end_, step_)) {
    fail(Status::kStepTooLarge, *why);
    return false;
  }
  stretch_.event = find_event();
  stretch_.loss = locate_loss(*model_, step_, stretch_.event ? stretch_.event->theta : 1.0);
  const auto theta = stretch_.theta();
  stretch_.end = theta ? std::min(step_.end_time(), step_.time(*theta)) : step_.end_time();
  stretch_.known = true;
  return true;
}

// Passes the stretch and handles its end.
void EventIntegrator::pass() {
  stretch_.known = false;
  move_to(stretch_.end, stretch_.theta());
  if (stretch_.loss) return fail_out_of_range();
  if (stretch_.event) {
    const std::size_t contact = stretch_.event->contact;
    if (stretch_.event->rejoins) {
      decide_one(contact, Constraint::Velocity::kAny);  // it has a force again, without an impact
    } else if (system_.has_margins(contact)) {
      margin_reached(contact);
    } else {
      impact(contact);
    }
    step_.restart(motion_);
    count_event();
  } else {
    project(system_.rigid_contacts());
  }
  step_.update_tolerances(motion_);
  observer_.update_energy_scale(motion_);
  if (result_.status != Status::kOk) return;
  if (motion_.t >= stretch_.limit && motion_.t < end_)
    arrive_at_break();  // this includes a break within an impact
  observer_.arrive(motion_);
}

// Moves by the step, or by a part of it.
void EventIntegrator::move_to(double now, std::optional<double> theta) {
  observer_.watch(motion_, step_, constraint_, now);
  if (theta) {
    step_.dense(*theta, motion_.y.data());
  } else {
    step_.accept(motion_);
  }
  // The way in which a flight began matters only at its start.
  if (now > motion_.t) {
    for (std::size_t k = 0; k < system_.contacts(); ++k) {
      if (!system_.has_margins(k) && !still_redundant(k)) system_.set(k, {});
    }
  }
  motion_.t = now;
}

bool EventIntegrator::still_redundant(std::size_t k) const {
  if (!system_.state(k).redundant) return false;
  const double clearance = model_->auxiliary[k].contact->clearance;
  return contact_point(*model_, motion_.q(), motion_.v(), k).gap <= kRedundantGap * clearance;
}

// The rotor or a ring has left its range.
void EventIntegrator::fail_out_of_range() {
  const auto reason = out_of_range(*model_, motion_.q(), motion_.v());
  fail(Status::kOutOfRange, reason.value_or("rotor or ring left its range"));
  step_.update_tolerances(motion_);
  observer_.update_energy_scale(motion_);
}

// Finds the first contact that closes, or the first margin that is crossed.
std::optional<EventIntegrator::FoundEvent> EventIntegrator::find_event() {
  std::optional<FoundEvent> first;
  for (std::size_t k = 0; k < system_.contacts(); ++k) {
    if (!model_->auxiliary[k].contact) continue;
    std::optional<double> theta;
    bool rejoins = false;
    if (system_.state(k).redundant) {
      if (const auto end =
              locate_redundant_end(*model_, k, step_, motion_, system_.state(k).redundant_gap)) {
        theta = end->theta;
        rejoins = !end->flew;
      }
    } else if (system_.has_margins(k)) {
      force_scale_[k] = std::max(force_scale_[k], std::abs(system_.margins(k).force));
      theta = locate_margin(k, step_, system_.state(k).mode, margin_scales(k), parameters_);
    } else {
      theta = locate_contact(*model_, k, step_, motion_, system_.state(k).departure);
    }
    if (theta && (!first || *theta < first->theta)) first = FoundEvent{*theta, k, rejoins};
  }
  return first;
}

void EventIntegrator::count_event() {
  const double t = motion_.t;
  if (t - last_event_ > 1e-15 * std::max(1e-3, t)) stalled_ = 0;
  last_event_ = t;
  if (++stalled_ > parameters_.stall_limit)
    fail(Status::kNoSolution, "more than " + std::to_string(parameters_.stall_limit) +
                                  " events at one instant, so the contact state does not settle");
}

void EventIntegrator::count_switching_work() {
  motion_.integral(kExternalWork) +=
      switching_work(*model_, switching_work_until_, motion_.t, motion_.q(), motion_.v());
  switching_work_until_ = motion_.t;
}

// Loads or the command jump here. Lasting contacts, and contacts lost at this very instant, are
// decided anew.
void EventIntegrator::arrive_at_break() {
  count_switching_work();
  sample_controllers();
  Closed resting;
  for (std::size_t k = 0; k < system_.contacts(); ++k) {
    const ContactState& state = system_.state(k);
    if (model_->auxiliary[k].is_compliant()) continue;
    const bool just_left =
        state.departure == Departure::kParting || state.departure == Departure::kLiftOff;
    if (system_.in_contact(k) || just_left) resting.push_back({k, velocity_of(state.mode)});
  }
  decide(resting);
  step_.restart(motion_);
}

// The controllers of the rings come first. As in fixed steps, they see the states that the earlier
// samples of the magnetic bearings left.
void EventIntegrator::sample_controllers() {
  const double* q = motion_.q();
  double* v = motion_.v();
  const auto take = [this](const auto& sample) {
    try {
      sample();
    } catch (const ControllerError& error) {
      controller_failed(error.what());
    }
  };
  for (std::size_t k = 0; k < system_.contacts(); ++k) {
    if (!schedule_.sample_due(k, motion_.t)) continue;
    if (has_control_states(model_->auxiliary[k])) {
      take([&] { take_control_sample(*model_, k, motion_.t, q, v); });
      system_.set_outputs(k, outputs_in_state(*model_, k, v));
      continue;
    }
    if (!model_->auxiliary[k].loop) {
      system_.hold_command(k, control_command(*model_, motion_.t, q, v, k));
      continue;
    }
    const Eigen::Vector2d last = system_.command(k, motion_.t, motion_.y.data());
    system_.hold_command(k, sampled_[k].take(motion_.t, q, v, last));
    system_.set_outputs(k, sampled_[k].outputs());
    if (!sampled_[k].failure().empty()) controller_failed(sampled_[k].failure());
  }
  for (std::size_t k = 0; k < model_->samplers.size(); ++k) {
    if (!schedule_.feedback_due(k, motion_.t)) continue;
    take([&] { take_sample(*model_, model_->samplers[k], motion_.t, q, v); });
  }
}

// why: the message, which contains the time.
void EventIntegrator::controller_failed(const std::string& why) {
  if (result_.status != Status::kOk) return;
  result_.status = Status::kControllerFailed;
  result_.message = why;
}

// If G_NN - mu s G_NT of a sliding contact approaches 0, its force grows without bound.
void EventIntegrator::fail_step() {
  for (std::size_t k = 0; k < system_.contacts(); ++k) {
    if (system_.state(k).mode != ContactMode::kSlide || model_->auxiliary[k].is_compliant())
      continue;
    ClosedContact c{k, {}};
    const ContactMatrix g = system_.accelerations(motion_.t, motion_.y.data(), std::span(&c, 1)).g;
    const double mu_sign =
        model_->auxiliary[k].contact->friction.at(c.point.slip) * system_.state(k).slip_sign;
    if (std::abs(g(0, 0) - mu_sign * g(0, 1)) < 1e-3 * g(0, 0)) {
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
  const bool several = system_.contacts() > 1;
  result_.message = why + " at t = " + std::to_string(motion_.t) + " s (" +
                    (several ? "contacts: " : "contact: ");
  for (std::size_t k = 0; k < system_.contacts(); ++k) {
    result_.message += (k > 0 ? ", " : "") + std::string(to_string(system_.state(k).mode));
  }
  result_.message += ")";
}

}  // namespace rotorub
