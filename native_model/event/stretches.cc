// An event-driven run that is driven from outside: inspected and cut between its events, saved and
// restored.

#include <memory>
#include <vector>

#include "native_model/event/driver.h"

namespace rotorub {

// Copies of the members of the integrator that have the same names.
struct EventIntegrator::Moving {
  Motion motion;
  Schedule schedule;
  Phase phase;
  SmoothStep step;
  StiffnessWatch stiffness;
  Observer observer;
  Ahead ahead;
  Result result;
  std::vector<SampledCommand> sampled;
  double end;
  std::vector<double> force_scale;
  int stalled;
  double last_event, booked;
};

std::shared_ptr<const EventIntegrator::Moving> EventIntegrator::save() const {
  return std::make_shared<const Moving>(Moving{motion_, schedule_, phase_, step_, stiffness_,
                                               observer_, ahead_, result_, sampled_, end_,
                                               force_scale_, stalled_, last_event_, booked_});
}

void EventIntegrator::restore(const Moving& saved) {
  motion_ = saved.motion;
  schedule_ = saved.schedule;
  phase_ = saved.phase;
  step_ = saved.step;
  stiffness_ = saved.stiffness;
  observer_ = saved.observer;
  ahead_ = saved.ahead;
  result_ = saved.result;
  sampled_ = saved.sampled;
  end_ = saved.end;
  force_scale_ = saved.force_scale;
  stalled_ = saved.stalled;
  last_event_ = saved.last_event;
  booked_ = saved.booked;
}

Snapshot EventIntegrator::within(double t) {
  return observer_.within(motion_, step_, constraint_, t);
}

Snapshot EventIntegrator::here() { return observer_.snapshot(motion_.t, motion_.y.data()); }

// The dense output of the step is computed on request, so the loads may jump only after that.
void EventIntegrator::cut(double t, const std::function<void()>& jump) {
  if (ahead_.known && t > motion_.t) {
    move_to(t, (t - motion_.t) / step_.length());
    project(phase_.rigid_contacts());
    step_.update_tolerances(motion_);
    observer_.update_energy_scale(motion_);
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
