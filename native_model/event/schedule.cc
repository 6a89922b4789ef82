#include "native_model/event/schedule.h"

#include <algorithm>
#include <cmath>

#include "native_model/control/sampling.h"

namespace rotorub {

void Schedule::begin(double start, double end) {
  const Model& m = *model_;
  breaks_ = {end};
  const auto add = [&](double t) {
    if (t > 0.0 && t < end) breaks_.push_back(t);
  };
  for (const AppliedForce& f : m.forces) {
    add(f.on);
    add(f.off);
    if (f.ramp > 0.0) add(f.on + f.ramp);
  }
  for (const DiscUnbalance& u : m.unbalances) add(u.on);
  if (m.feedback) add(m.feedback->law.fails_at);
  if (m.drive_follows()) add(m.drive->ramp_end());
  if (m.controller) {
    add(m.control_on);
    for (double t : m.controller->breaks(m.control_on)) add(t);
  }
  if (m.recorded) {
    // Of a run from one contact to the next there are few.
    const std::vector<double>& jumps = m.recorded->jumps();
    const auto first = std::upper_bound(jumps.begin(), jumps.end(), start);
    breaks_.insert(breaks_.end(), first, std::lower_bound(first, jumps.end(), end));
  }
  std::sort(breaks_.begin(), breaks_.end());
  breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
  next_sample_ = m.sample_time > 0.0 ? std::ceil(start / m.sample_time - 1e-9) : 0.0;
}

double Schedule::next(double t) const {
  const auto after = std::upper_bound(breaks_.begin(), breaks_.end(), t);
  const double limit = after == breaks_.end() ? breaks_.back() : *after;
  if (!model_->controller || model_->sample_time <= 0.0) return limit;
  const double sample = next_sample_ * model_->sample_time;
  return sample > t ? std::min(limit, sample) : limit;
}

bool Schedule::sample_due(double t) {
  const Model& m = *model_;
  if (m.recorded) return true;  // a break may be a jump; the record tells it at no cost
  if (!m.controller || m.sample_time <= 0.0) return false;
  const bool starts = t == m.control_on;  // the first command is taken at switch-on
  if (!starts && t < next_sample_ * m.sample_time) return false;
  next_sample_ = sample_index(t, m.sample_time) + 1.0;
  return t >= m.control_on;
}

}  // namespace rotorub
