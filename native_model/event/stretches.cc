// An event-driven run that is driven from outside: inspected and cut between its events, saved and
// restored.

#include <memory>
#include <tuple>
#include <utility>

#include "native_model/event/driver.h"

namespace rotorub {

template <class Self>
auto EventIntegrator::moving_members(Self& self) {
  return std::tie(self.motion_, self.schedule_, self.system_, self.step_, self.stiffness_,
                  self.observer_, self.stretch_, self.result_, self.sampled_, self.end_,
                  self.force_scale_, self.stalled_, self.last_event_, self.switching_work_until_);
}

namespace {

// The type of the values of a tuple of references.
template <class... Members>
std::tuple<Members...> values_of(std::tuple<Members&...>);

}  // namespace

struct EventIntegrator::Moving {
  decltype(values_of(moving_members(std::declval<EventIntegrator&>()))) values;
};

std::shared_ptr<const EventIntegrator::Moving> EventIntegrator::save() const {
  return std::make_shared<const Moving>(Moving{moving_members(*this)});
}

void EventIntegrator::restore(const Moving& saved) { moving_members(*this) = saved.values; }

Snapshot EventIntegrator::within(double t) {
  return observer_.within(motion_, step_, constraint_, t);
}

Snapshot EventIntegrator::here() { return observer_.snapshot(motion_.t, motion_.y.data()); }

// The dense output of the step is computed on request, so the loads may jump only after that.
void EventIntegrator::cut(double t, const std::function<void()>& jump) {
  if (stretch_.known && t > motion_.t) {
    move_to(t, (t - motion_.t) / step_.length());
    project(system_.rigid_contacts());
    step_.update_tolerances(motion_);
    observer_.update_energy_scale(motion_);
  }
  stretch_.known = false;
  jump();
  arrive_at_break();
}

void EventIntegrator::extend_end(double end) {
  const bool ended = motion_.t >= end_;
  schedule_.find_breaks(motion_.t, end);
  end_ = end;
  if (ended) arrive_at_break();
}

}  // namespace rotorub
