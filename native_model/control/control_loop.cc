#include "native_model/control/control_loop.h"

#include <utility>

#include "native_model/control/touch.h"

namespace rotorub {
namespace {

// What is remembered, before what the sensors and the law do.
enum LoopMemory : std::size_t {
  kRuns,
  kOnTime,
  kOnGap,
  kOnGapRate,
  kTouch,
  kOutputs = kTouch + kTouchState,
  kSingle = kOutputs + kMostOutputs
};

}  // namespace

ControlLoop::ControlLoop(std::shared_ptr<const Controller> law, const scene::Sensors& sensors,
                         const std::optional<scene::Trigger>& trigger, double sample_time,
                         double clearance)
    : law_(std::move(law)),
      sensors_(sensors, sample_time),
      trigger_(trigger),
      clearance_(clearance) {}

std::size_t ControlLoop::memory_size() const {
  return kSingle + sensors_.memory_size() + law_->state_size();
}

Eigen::Vector2d ControlLoop::sample(const Measurement& truth, double* memory) const {
  const Measurement now = sensors_.measure(truth, memory + kSingle);
  double* state = memory + kSingle + sensors_.memory_size();
  if (memory[kRuns] == 0.0) {
    const SeenGap gap = seen_gap(now, clearance_);
    const SwitchOn on{now.t, gap.gap, gap.rate};
    const bool touch = trigger_ && trigger_->touch && touched(now, clearance_, memory + kTouch);
    if (!touch && !lets_in(on)) return {0.0, 0.0};
    memory[kRuns] = 1.0;
    memory[kOnTime] = on.t;
    memory[kOnGap] = on.gap;
    memory[kOnGapRate] = on.gap_rate;
    law_->start(state);
  }
  const SwitchOn on{memory[kOnTime], memory[kOnGap], memory[kOnGapRate]};
  const Eigen::Vector2d asked = law_->command(now, on, state);
  law_->output(now, on, state, memory + kOutputs);
  return asked;
}

const double* ControlLoop::outputs(const double* memory) { return memory + kOutputs; }

bool ControlLoop::lets_in(const SwitchOn& now) const {
  if (!trigger_) return true;
  if (trigger_->gap && now.gap <= *trigger_->gap) return true;
  return trigger_->time_to_touch && now.gap_rate < 0.0 &&
         now.gap <= -now.gap_rate * *trigger_->time_to_touch;
}

}  // namespace rotorub
