// The loop of the event-driven integrator: steps and breaks. Where events are found stands in
// event_location.cc, what happens there in event_contact.cc, the output in event_rows.cc.
#include "native_model/integrate/event.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "native_model/control/sampling.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/trajectory/range_check.h"

namespace rotorub {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Instants at which the right-hand side is not smooth.
std::vector<double> make_breaks(const Model& m, double end) {
  std::vector<double> breaks{end};
  const auto add = [&](double t) {
    if (t > 0.0 && t < end) breaks.push_back(t);
  };
  for (const AppliedForce& f : m.forces) {
    add(f.on);
    add(f.off);
    if (f.ramp > 0.0) add(f.on + f.ramp);
  }
  if (m.controller) {
    add(m.control_on);
    for (double t : m.controller->breaks()) add(t);
  }
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  return breaks;
}

}  // namespace

EventIntegrator::EventIntegrator(const Model& model, const EventOptions& options)
    : model_(&model), options_(options), phase_(model), step_(phase_.size()) {
  const auto size = static_cast<std::size_t>(phase_.size());
  for (auto* buffer : {&y_, &row_, &row_slope_, &tolerance_}) buffer->assign(size, 0.0);
  for (auto* buffer :
       {&load_, &touch_.force, &touch_.acceleration, &touch_.before, &touch_.after}) {
    buffer->assign(static_cast<std::size_t>(model.nq()), 0.0);
  }
}

void EventIntegrator::fail(Status status, const std::string& why) {
  if (result_.status != Status::kOk) return;
  result_.status = status;
  result_.message =
      why + " at t = " + std::to_string(t_) + " s, " + to_string(phase_.mode()) + " contact state";
}

double EventIntegrator::next_break() const {
  const auto next = std::upper_bound(breaks_.begin(), breaks_.end(), t_);
  double limit = next == breaks_.end() ? end_ : *next;
  if (model_->controller && model_->sample_time > 0.0) {
    const double sample = next_sample_ * model_->sample_time;
    if (sample > t_) limit = std::min(limit, sample);
  }
  return limit;
}

// At a sampling instant: takes the command from the state. True where it did.
bool EventIntegrator::sample_controller() {
  const Model& m = *model_;
  if (!m.controller || m.sample_time <= 0.0) return false;
  const bool starts = t_ == m.control_on;  // the first command is taken at switch-on
  if (!starts && t_ < next_sample_ * m.sample_time) return false;
  next_sample_ = sample_index(t_, m.sample_time) + 1.0;
  if (t_ >= m.control_on) phase_.hold(control_command(m, t_, q(), v()));
  return true;
}

// Tolerances relative to the largest of each kind met so far: displacements, speeds, angles, spin;
// of currents relative to their limit.
void EventIntegrator::update_tolerances() {
  const Layout& l = model_->layout;
  const int n = l.nq();
  for (int i = 0; i < l.mechanical(); ++i) {
    const bool angle = i >= l.phi() && i < l.ring();
    const double position = std::abs(y_[static_cast<std::size_t>(i)]);
    const double speed = std::abs(y_[static_cast<std::size_t>(n + i)]);
    double& largest_position = angle ? largest_turn_ : largest_displacement_;
    double& largest_rate = angle ? largest_spin_ : largest_speed_;
    const bool spin = l.spin && i == l.phi();
    // The spin angle only grows; what matters of it is its part of a turn.
    largest_position = std::max(largest_position, spin ? 0.0 : position);
    largest_rate = std::max(largest_rate, speed);
  }
  for (int i = 0; i < l.mechanical(); ++i) {
    const bool angle = i >= l.phi() && i < l.ring();
    tolerance_[static_cast<std::size_t>(i)] =
        options_.tolerance * (angle ? 1.0 : largest_displacement_);
    tolerance_[static_cast<std::size_t>(n + i)] =
        options_.tolerance * (angle ? std::max(1.0, largest_spin_) : largest_speed_);
  }
  // Nothing hangs on a coil's charge.
  for (int i = l.coil(); i < n; ++i) {
    tolerance_[static_cast<std::size_t>(i)] = kInfinity;
    tolerance_[static_cast<std::size_t>(n + i)] =
        options_.tolerance * model_->magnets->current_limit;
  }
  for (int k = 0; k < kIntegrals; ++k) {
    tolerance_[static_cast<std::size_t>(2 * n + k)] = kInfinity;
  }
}

void EventIntegrator::begin(const State& start) {
  const Model& m = *model_;
  t_ = start.t;
  std::fill(y_.begin(), y_.end(), 0.0);
  std::copy_n(start.q.data(), m.nq(), q());
  std::copy_n(start.v.data(), m.nq(), v());
  result_ = {};
  largest_displacement_ = m.contact ? m.contact->clearance : 1e-6;
  largest_speed_ = 1e-6;
  largest_turn_ = largest_spin_ = 0.0;
  contact_time_ = impact_work_ = impact_impulse_ = bin_start_ = impact_force_ = 0.0;
  bin_ = options_.force_bin > 0.0 ? std::floor(t_ / options_.force_bin) : 0.0;
  force_scale_ = 1e-300;
  stalled_ = 0;
  last_event_ = -1.0;
  energy_scale_ = 0.0;
  meet_energy();
  energy_start_ = energy(m, t_, q(), v());
  next_sample_ = m.sample_time > 0.0 ? std::ceil(t_ / m.sample_time - 1e-9) : 0.0;
  phase_.set(Mode::kFree, 1.0);
  phase_.first_touch(kInfinity);
  phase_.hold({0.0, 0.0});
  departure_ = Departure::kInside;
  update_tolerances();
  sample_controller();
  if (!m.contact) return;
  // A start on the circle: moving outward it is an impact, at rest lasting contact.
  const ContactPoint p = contact_point(m, q(), v());
  if (p.gap > 1e-12 * m.contact->clearance) return;
  if (p.gap_rate < 0.0) {
    impact();
  } else if (p.gap_rate <= options_.closing_gap_rate) {
    project(true, false);
    decide(false, Departure::kParting);
  } else {
    project(false, false);
    departure_ = Departure::kRebound;
  }
}

// Sliding whose G_NN - mu s G_NT runs into 0 needs forces without bound.
void EventIntegrator::fail_step() {
  if (phase_.mode() == Mode::kSlide) {
    const Delassus g = phase_.contact(t_, y_.data()).g;
    if (std::abs(carried(g, model_->contact->friction * phase_.sign())) < 1e-3 * g.nn) {
      return fail(
          Status::kNoSolution,
          "sliding begins to push itself in (mu |G_NT| reaches G_NN, Painleve): the contact "
          "forces grow without bound");
    }
  }
  fail(Status::kDiverged, "no step is small enough: the state is no longer smooth or finite");
}

double EventIntegrator::trial_until_accepted(double limit) {
  const auto f = [this](double t, const double* y, double* dy) {
    phase_.derivative(before_break(t), y, dy);
    const Phase::Margins& m = phase_.margins();
    lowest_.force = std::min(lowest_.force, m.force);
    lowest_.cone = std::min(lowest_.cone, m.cone);
  };
  for (;;) {
    const double h = std::min(h_, limit - t_);
    lowest_ = {kInfinity, kInfinity};
    const double error = step_.trial(f, t_, y_.data(), h, tolerance_.data());
    const double factor = error == 0.0 ? 6.0 : std::clamp(0.9 * std::pow(error, -0.125), 0.2, 6.0);
    if (error <= 1.0) {
      // A step cut short by a break says little of the next one.
      h_ = h < h_ ? std::max(h_, h * factor) : h * factor;
      return h;
    }
    ++result_.rejected;
    h_ = h * std::min(factor, 0.9);
    if (!(h_ > 1e-15 * std::max(1e-3, std::abs(t_)))) {
      fail_step();
      return 0.0;
    }
  }
}

void EventIntegrator::advance(double limit) {
  dense_ready_ = false;
  smooth_end_ = std::nextafter(limit, t_);
  const double h = trial_until_accepted(limit);
  if (result_.status != Status::kOk) return;
  ++result_.steps;
  double theta = locate();
  if (result_.status != Status::kOk) return;
  const std::optional<std::string> lost = out_of_range(*model_, step_.end());
  if (lost) theta = std::min(theta, locate_loss());
  const bool event = theta <= 1.0;
  // A whole step up to a break arrives there to the bit.
  double now = t_ + h;
  if (limit - now <= 1e-14 * limit || h >= limit - t_) now = limit;
  if (event) now = std::min(now, t_ + theta * h);
  rows_before(now);
  bins_until(now);
  if (phase_.mode() != Mode::kFree) contact_time_ += now - t_;
  if (event) {
    step_.dense(theta, y_.data());
  } else {
    std::copy_n(step_.end(), y_.size(), y_.begin());
    step_.advance();
  }
  t_ = now;
  if (const auto reason = lost ? out_of_range(*model_, q()) : std::nullopt) {
    return fail(Status::kOutOfRange, *reason);
  }
  if (event) {
    if (phase_.mode() == Mode::kFree) {
      impact();
    } else {
      end_of_contact();
    }
    phase_.derivative(t_, y_.data(), step_.first_slope());
    if (t_ - last_event_ > 1e-15 * std::max(1e-3, t_)) stalled_ = 0;
    last_event_ = t_;
    if (++stalled_ > options_.stall_limit) fail(Status::kNoSolution, "events without end");
  } else if (phase_.mode() == Mode::kFree) {
    departure_ = Departure::kInside;
  } else {
    project(true, phase_.mode() == Mode::kStick);
  }
  update_tolerances();
  meet_energy();
}

// Loads or the command jump here: lasting contact, and contact lost this very instant, is decided
// anew.
void EventIntegrator::arrive_at_break() {
  sample_controller();
  const bool just_left = departure_ == Departure::kParting || departure_ == Departure::kLiftOff;
  if (phase_.mode() != Mode::kFree || just_left) {
    decide(phase_.mode() == Mode::kStick, Departure::kParting);
  }
  phase_.derivative(t_, y_.data(), step_.first_slope());
}

void EventIntegrator::prepare_dense() {
  if (dense_ready_) return;
  step_.prepare_dense(
      [this](double t, const double* y, double* dy) { phase_.derivative(before_break(t), y, dy); },
      t_);
  dense_ready_ = true;
}

EventIntegrator::Result EventIntegrator::run(const State& start, double end, Recorder& recorder,
                                             const std::function<void(double)>& progress,
                                             const std::atomic<bool>* interrupt) {
  recorder_ = &recorder;
  end_ = end;
  breaks_ = make_breaks(*model_, end);
  h_ = std::min(1e-6, end - start.t);
  begin(start);
  recorder.begin(snapshot(t_, y_.data()));
  recorder.statistics().energy_start = energy_start_;
  phase_.derivative(t_, y_.data(), step_.first_slope());
  std::int64_t ticks = 0;
  while (t_ < end_ && result_.status == Status::kOk) {
    const double limit = next_break();
    advance(limit);
    if (result_.status != Status::kOk) break;
    if (t_ >= limit && t_ < end_) arrive_at_break();  // an impact that takes time may pass one
    rows_at_now();
    if ((ticks++ & 0xff) == 0) {
      if (progress) progress(t_ / end_);
      if (interrupt && interrupt->load(std::memory_order_relaxed)) {
        fail(Status::kInterrupted, "interrupted");
      }
    }
  }
  result_.end = t_;
  fill_statistics();
  if (const auto reason = out_of_balance(recorder.statistics())) {
    fail(Status::kOutOfRange, *reason);
  }
  return result_;
}

}  // namespace rotorub
