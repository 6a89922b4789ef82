#include "compare/engine/watch_feed.h"

#include <algorithm>

#include "native_model/dynamics/dynamics.h"

namespace rotorub {

WatchFeed::WatchFeed(const Model& model, double step, StepWatch watch)
    : model_(model),
      h_(step),
      watch_(std::move(watch)),
      lags_(model.first().magnets && model.first().magnets->coil_lag > 0.0) {}

void WatchFeed::begin(const double* q, const double* v) {
  if (!watch_) return;
  q_.assign(q, q + model_.nq());
  v_.assign(v, v + model_.nq());
  mean_ = v_;
}

void WatchFeed::step(std::int64_t k, const double* q, const double* v, const StepResult& r) {
  if (!watch_) return;
  for (std::size_t i = 0; i < v_.size(); ++i) mean_[i] = k == 0 ? v_[i] : 0.5 * (v_[i] + v[i]);
  tell(k, q_.data(), mean_.data(), h_, r);
  std::copy_n(q, q_.size(), q_.begin());
  std::copy_n(v, v_.size(), v_.begin());
}

void WatchFeed::native_step(std::int64_t k, const double* q, const double* v, const StepResult& r) {
  if (!watch_) return;
  tell(k, q, v, k == 0 ? 0.5 * h_ : h_, r);
}

// `kick`: s, that the step's forces are for.
void WatchFeed::tell(std::int64_t k, const double* q, const double* v, double kick,
                     const StepResult& r) {
  const plugin::ContactForces& f = r.forces;
  WatchedStep s;
  s.t = static_cast<double>(k) * h_;
  s.h = h_;
  s.q = q;
  s.v = v;
  s.current = current_;
  s.command = r.command;
  // The current of a coil that lags follows from the step's begin on.
  s.command_begin = k == 0 || lags_ ? s.t : s.t - 0.5 * h_;
  s.normal_impulse = kick * f.normal;
  s.impact = f.impact;
  if (f.impact) {
    s.gap_rate_after = f.gap_rate_after;
    s.impact_time = f.impact_time;
    if (s.impact_time == 0.0) {  // not located: when the gap of t closes, within the step
      const double gap = contact_point(model_, q, v).gap;
      s.impact_time = s.t + std::clamp(gap / std::max(-f.gap_rate_before, 1e-300), 0.0, h_);
    }
  }
  watch_(s);
  current_ = r.actuator.current;
}

}  // namespace rotorub
