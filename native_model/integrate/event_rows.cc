// What the event-driven integrator hands to the recorder: rows at exact times, force bins, figures.
#include <algorithm>
#include <cmath>

#include "native_model/integrate/event.h"
#include "native_model/dynamics/dynamics.h"

namespace rotorub {

Snapshot EventIntegrator::snapshot(double t, const double* y) {
  phase_.derivative(t, y, row_slope_.data());
  Snapshot s;
  s.t = t;
  s.q = y;
  s.v = y + model_->nq();
  s.normal_force = std::max(0.0, phase_.multipliers().normal);
  s.friction_force = phase_.multipliers().friction;
  s.mode = phase_.mode();
  s.actuator = actuator_state(*model_, s.q, s.v, phase_.command(t, y));
  return s;
}

// Normal impulse of the run from its start until t, N s; t within the current step or impact phase.
double EventIntegrator::impulse_until(double t) {
  const int impulse = 2 * model_->nq() + kNormalImpulse;
  double carried = y_[static_cast<std::size_t>(impulse)] + impact_force_ * (t - t_);
  if (phase_.mode() != Mode::kFree) {
    prepare_dense();
    carried += step_.increment(impulse, (t - t_) / step_.step());
  }
  return carried + impact_impulse_;
}

void EventIntegrator::meet_energy() {
  energy_scale_ = std::max(energy_scale_, std::abs(energy(*model_, t_, q(), v())));
}

// Normal force averaged over bins of fixed width, as a fixed-step engine has it: peak and mean
// square. Free flight carries no force, and only what an impact left in the current bin counts.
void EventIntegrator::bins_until(double now) {
  if (options_.force_bin <= 0.0) return;
  const bool flies = phase_.mode() == Mode::kFree && impact_force_ == 0.0;
  for (double edge = (bin_ + 1) * options_.force_bin; edge <= now;
       edge = (bin_ + 1) * options_.force_bin) {
    const double total = impulse_until(edge), force = (total - bin_start_) / options_.force_bin;
    Statistics& s = recorder_->statistics();
    s.peak_force = std::max(s.peak_force, force);
    s.force_square += force * force * options_.force_bin;
    bin_start_ = total;
    ++bin_;
    if (flies && force == 0.0) bin_ = std::max(bin_, std::floor(now / options_.force_bin) - 1.0);
  }
}

void EventIntegrator::rows_before(double t) {
  while (recorder_->next_time() < t) {
    prepare_dense();
    const double time = recorder_->next_time();
    step_.dense((time - t_) / step_.step(), row_.data());
    if (phase_.mode() != Mode::kFree) to_circle(time, row_.data());
    recorder_->row(snapshot(time, row_.data()));
  }
}

void EventIntegrator::rows_at_now() {
  while (recorder_->next_time() <= t_) recorder_->row(snapshot(t_, y_.data()));
}

void EventIntegrator::fill_statistics() {
  Statistics& s = recorder_->statistics();
  const double* integral = y_.data() + 2 * model_->nq();
  if (std::isfinite(phase_.first_touch())) s.first_touch = phase_.first_touch();
  s.contact_time = contact_time_;
  s.impulse_total += integral[kNormalImpulse];
  s.friction_impulse += integral[kFrictionImpulse];
  s.friction_work += integral[kFrictionWork];
  s.gap_rate_square = integral[kGapRateSquare];
  s.contact_work = integral[kContactWork] + impact_work_;
  s.external_work = integral[kExternalWork];
  s.energy_end = energy(*model_, t_, q(), v());
  s.energy_scale = std::max(energy_scale_, std::abs(s.energy_end));
}

}  // namespace rotorub
