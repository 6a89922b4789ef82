#include "compare/study/onsets.h"

#include <algorithm>

#include "native_model/dynamics/dynamics.h"

namespace rotorub {

void OnsetWatch::step(const WatchedStep& s) {
  if (s.normal_impulse > 0.0) {
    if (flew()) meet(s);
    if (open_) add(s);
    flight_ = 0;
  } else {
    if (open_ && flight_ == 0) part(s);
    ++flight_;
  }
  const Layout& l = model_->layout;
  before_.t = s.t;
  before_.q = Eigen::VectorXd::Zero(l.nq());
  before_.v = Eigen::VectorXd::Zero(l.nq());
  before_.q.head(l.coil()) = Eigen::Map<const Eigen::VectorXd>(s.q, l.coil());
  before_.v.head(l.coil()) = Eigen::Map<const Eigen::VectorXd>(s.v, l.coil());
  for (int k = 0; k < l.coils; ++k) before_.v[l.coil() + k] = s.current[k];
}

// A free phase is over.
void OnsetWatch::meet(const WatchedStep& s) {
  if (open_) onsets_.back().end = 0.5 * (last_force_ + s.t);
  open_ = false;
  const ContactPoint p = contact_point(*model_, before_.q.data(), before_.v.data());
  if (p.gap <= 0.0 || p.gap_rate >= 0.0) {
    ++left_out_;
    return;
  }
  Onset onset;
  onset.before = before_;
  onset.touch = std::min(before_.t + p.gap / -p.gap_rate, s.t + s.h);
  onset.closing = -p.gap_rate;
  onsets_.push_back(std::move(onset));
  open_ = true;
  rebounded_ = false;
  window_ = ImpulseWindow(kWindowSteps * s.h);
}

void OnsetWatch::add(const WatchedStep& s) {
  Onset& o = onsets_.back();
  ContactResult& c = o.mujoco;
  if (s.impact && c.impulse == 0.0) o.touch = s.impact_time;
  c.impulse += s.normal_impulse;
  window_.add(s.impact ? s.impact_time : s.t, s.normal_impulse);
  c.window_impulse = window_.largest();
  // Force that is no impact's acts about the step's instant.
  last_force_ = s.impact ? s.impact_time : s.t + 0.5 * s.h;
  c.duration = std::max(0.0, last_force_ - o.touch);
  if (s.impact && !rebounded_) {
    c.rebound = s.gap_rate_after;
    rebounded_ = true;
  }
}

// The first step without a force after some with.
void OnsetWatch::part(const WatchedStep& s) {
  if (rebounded_) return;
  onsets_.back().mujoco.rebound = contact_point(*model_, s.q, s.v).gap_rate;
  rebounded_ = true;
}

std::vector<Onset> OnsetWatch::finish(double end) {
  if (open_) {
    onsets_.back().lasts = !flew();
    onsets_.back().end = flew() ? 0.5 * (last_force_ + end) : end;
  }
  open_ = false;
  return std::move(onsets_);
}

}  // namespace rotorub
