#include "native_model/control/two_phase.h"

#include "native_model/control/gap_reference.h"
#include "native_model/control/touch.h"

namespace rotorub {
namespace {

enum State : std::size_t {
  kHandedOver,
  kTime,
  kLeftX,
  kLeftY,
  kTouchSeen,
  kTrack = kTouchSeen + kTouchState
};

}  // namespace

TwoPhase::TwoPhase(const scene::Controller& settings, const Plant& plant, double spin_speed)
    : track_(settings, plant, spin_speed),
      cross_(settings),
      clearance_(plant.clearance),
      handover_time_(settings.handover_time) {}

std::size_t TwoPhase::state_size() const { return kTrack + track_.state_size(); }

void TwoPhase::start(double* state) const { track_.start(state + kTrack); }

Eigen::Vector2d TwoPhase::command(const Measurement& now, const SwitchOn& on, double* state) const {
  const bool touches = touched(now, clearance_, state + kTouchSeen);
  if (state[kHandedOver] == 0.0) {
    const Eigen::Vector2d tracking = track_.command(now, on, state + kTrack);
    if (!touches) return tracking;
    const Eigen::Vector2d left = tracking - cross_.command(now, on, nullptr);
    state[kHandedOver] = 1.0;
    state[kTime] = now.t;
    state[kLeftX] = left.x();
    state[kLeftY] = left.y();
    return tracking;
  }
  const double left = 1.0 - gap_reference({state[kTime], 0.0, 0.0}, now.t, handover_time_).share;
  return cross_.command(now, on, nullptr) + left * Eigen::Vector2d(state[kLeftX], state[kLeftY]);
}

}  // namespace rotorub
