// An event-driven run that is driven from outside: inspected and cut between its events, saved and
// restored.

#include <tuple>

#include "native_model/event/driver.h"

namespace rotorub {

struct EventIntegrator::Moving {
  std::tuple<Motion, Schedule, Phase, SmoothStep, StiffnessWatch, Observer, Ahead, Result,
             std::vector<SampledCommand>, double, std::vector<double>, int, double, double>
      values;

  // References to the members of the integrator, in the order of `values`.
  template <class Integrator>
  static auto members(Integrator& of) {
    return std::tie(of.motion_, of.schedule_, of.phase_, of.step_, of.stiffness_, of.observer_,
                    of.ahead_, of.result_, of.sampled_, of.end_, of.force_scale_, of.stalled_,
                    of.last_event_, of.booked_);
  }
};

std::shared_ptr<const EventIntegrator::Moving> EventIntegrator::save() const {
  return std::make_shared<const Moving>(Moving{Moving::members(*this)});
}

void EventIntegrator::restore(const Moving& saved) { Moving::members(*this) = saved.values; }

Snapshot EventIntegrator::within(double t) {
  return observer_.within(motion_, step_, constraint_, t);
}

Snapshot EventIntegrator::here() { return observer_.snapshot(motion_.t, motion_.y.data()); }

// The dense output of the step is computed on request, so the loads may jump only after that.
void EventIntegrator::cut(double t, const std::function<void()>& jump) {
  if (ahead_.known && t > motion_.t) {
    move_to(t, (t - motion_.t) / step_.length());
    project(phase_.rigid_contacts());
    step_.meet(motion_);
    observer_.meet_energy(motion_);
  }
  ahead_.known = false;
  jump();
  arrive_at_break();
}

void EventIntegrator::put_off_end(double end) {
  const bool ended = motion_.t >= end_;
  schedule_.find_breaks(motion_.t, end);
  end_ = end;
  if (ended) arrive_at_break();
}

}  // namespace rotorub
