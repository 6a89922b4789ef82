#include "native_model/event/schedule.h"

#include <algorithm>
#include <cmath>

#include "native_model/control/control_loop.h"
#include "native_model/model/loads.h"

namespace rotorub {

void Schedule::find_breaks(double start, double end) {
  const Model& m = *model_;
  breaks_ = {end};
  const auto add = [&](double t) {
    if (t > 0.0 && t < end) breaks_.push_back(t);
  };
  equations::for_each_switch(m, add);
  for (const AppliedForce& f : m.forces) add(f.on + f.ramp);
  if (m.base) std::ranges::for_each(m.base->breaks(), add);
  if (m.drive_follows()) add(m.drive->ramp_end());
  for (const AuxiliaryBearing& at : m.auxiliary) {
    if (at.controller) {
      add(at.control_on);
      for (double t : at.controller->breaks(at.control_on)) add(t);
    }
    if (!at.recorded) continue;
    // Only jumps within the run are copied; short runs have few.
    const std::vector<double>& jumps = at.recorded->jumps();
    const auto first = std::upper_bound(jumps.begin(), jumps.end(), start);
    breaks_.insert(breaks_.end(), first, std::lower_bound(first, jumps.end(), end));
  }
  std::sort(breaks_.begin(), breaks_.end());
  breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
}

void Schedule::begin(double start, double end) {
  const Model& m = *model_;
  find_breaks(start, end);
  next_feedback_.clear();
  for (const SampledFeedback& s : m.samplers) {
    next_feedback_.push_back(std::ceil(start / s.sample_time - 1e-9));
  }
  next_sample_.clear();
  for (const AuxiliaryBearing& at : m.auxiliary) {
    next_sample_.push_back(at.sample_time > 0.0 ? std::ceil(start / at.sample_time - 1e-9) : 0.0);
  }
}

double Schedule::next(double t) const {
  const auto after = std::upper_bound(breaks_.begin(), breaks_.end(), t);
  double limit = after == breaks_.end() ? breaks_.back() : *after;
  for (std::size_t k = 0; k < next_sample_.size(); ++k) {
    const AuxiliaryBearing& at = model_->auxiliary[k];
    if (!at.controller || at.sample_time <= 0.0) continue;
    const double sample = next_sample_[k] * at.sample_time;
    if (sample > t) limit = std::min(limit, sample);
  }
  for (std::size_t k = 0; k < next_feedback_.size(); ++k) {
    const double sample = next_feedback_[k] * model_->samplers[k].sample_time;
    if (sample > t) limit = std::min(limit, sample);
  }
  return limit;
}

bool Schedule::feedback_due(std::size_t sampler, double t) {
  double& next = next_feedback_[sampler];
  const double every = model_->samplers[sampler].sample_time;
  if (t < next * every) return false;
  next = sample_index(t, every) + 1.0;
  return true;
}

bool Schedule::sample_due(std::size_t bearing, double t) {
  const AuxiliaryBearing& at = model_->auxiliary[bearing];
  if (at.recorded) return true;  // a break may be a jump of the record; asking it is cheap
  if (!at.controller || at.sample_time <= 0.0) return false;
  const bool starts = t == at.control_on;  // the first command is taken at switch-on
  double& next = next_sample_[bearing];
  if (!starts && t < next * at.sample_time) return false;
  next = sample_index(t, at.sample_time) + 1.0;
  return t >= at.control_on;
}

}  // namespace rotorub
