#include "native_model/trajectory/contact_episodes.h"

#include <algorithm>

#include "native_model/trajectory/status_reason.h"

namespace rotorub {

void ContactEpisodes::step(const SoftStep& s) {
  const bool loaded = s.normal > 0.0;
  if (loaded && !open_) {
    open_ = true;
    // The gap was open a step earlier; linear interpolation gives the instant at which it closed.
    const double fall = last_gap_ - s.before.gap;
    const double share = fall > 0.0 && s.t > 0.0 ? std::clamp(-s.before.gap / fall, 0.0, 1.0) : 0.0;
    impact_ = Impact{};
    impact_.contact = contact_;
    begin_ = s.t;
    lasted_ = 0.0;
    impact_.t = s.t - share * s.h;
    const ContactPoint& approach = s.approach ? *s.approach : s.before;
    impact_.gap_rate_before = approach.gap_rate;
    impact_.slip_before = approach.slip;
    recorder_->add(Event{impact_.t, EventKind::kImpact, contact_});
  }
  if (s.mode != mode_) {
    recorder_->add(Event{s.t, mode_event(s.mode), contact_});
    mode_ = s.mode;
  }
  if (loaded) {
    lasted_ += s.h;
    impact_.normal_impulse += s.h * s.normal;
    impact_.friction_impulse += s.h * s.friction;
    impact_.energy_change += 0.5 * s.h *
                             (s.normal * (s.before.gap_rate + s.after.gap_rate) +
                              s.friction * (s.before.slip + s.after.slip));
    impact_.gap_rate_after = s.after.gap_rate;
    impact_.slip_after = s.after.slip;
  } else {
    finish();
  }
  last_gap_ = s.before.gap;
}

void ContactEpisodes::finish() {
  if (open_) {
    recorder_->add(impact_);
    recorder_->count_episode(begin_, lasted_);
  }
  open_ = false;
}

}  // namespace rotorub
