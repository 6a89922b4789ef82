#include "native_model/run/step_commands.h"

#include <algorithm>

namespace rotorub {
namespace {

// First jump of a recorded command within begin..end, s.
CommandJump first_command_jump(const CommandRecord& record, double begin, double end) {
  const std::vector<double>& jumps = record.jumps();
  const auto next = std::upper_bound(jumps.begin(), jumps.end(), begin);
  if (next == jumps.end() || *next >= end) return {};
  return {(*next - begin) / (end - begin), record.mean(begin, *next), record.mean(*next, end)};
}

}  // namespace

StepCommands::StepCommands(const Model& model, FixedStepper& stepper, double step)
    : model_(model),
      stepper_(stepper),
      step_(step),
      velocity_(static_cast<std::size_t>(model.nq())),
      acceleration_(velocity_) {
  for (std::size_t i = 0; i < model.auxiliary.size(); ++i) {
    holds_.emplace_back(model, i);
    idle_ = idle_ && !model.auxiliary[i].controller && !model.auxiliary[i].recorded;
  }
}

void StepCommands::hold(std::int64_t k) {
  if (idle_) return;
  const double t = time(k);
  for (std::size_t i = 0; i < holds_.size(); ++i) {
    const CommandRecord* recorded = model_.auxiliary[i].recorded.get();
    command_[i] =
        recorded ? recorded->mean(t, time(k + 1)) : holds_[i].at(t, stepper_.q(), stepper_.v());
    shown_[i] = command_[i];
    note_failure(holds_[i]);
  }
}

void StepCommands::mean_about(std::int64_t k) {
  if (idle_) return;
  const double t = time(k), end = t + 0.5 * step_, begin = k == 0 ? t : t - 0.5 * step_;
  bool known = false;
  for (std::size_t i = 0; i < holds_.size(); ++i) shown_[i] = holds_[i].held();
  for (std::size_t i = 0; i < holds_.size(); ++i) {
    command_[i] = holds_[i].held();
    if (const CommandRecord* recorded = model_.auxiliary[i].recorded.get()) {
      stepper_.announce_command_jump(i, first_command_jump(*recorded, begin, end));
      command_[i] = shown_[i] = recorded->mean(begin, end);
      continue;
    }
    if (!holds_[i].needs_state(end)) continue;
    if (!known) find_velocities(k);
    known = true;
    command_[i] =
        holds_[i].mean(begin, t, end, stepper_.q(), velocity_.data(), acceleration_.data());
    shown_[i] = holds_[i].held();
    stepper_.announce_command_jump(i, holds_[i].command_jump());
    note_failure(holds_[i]);
  }
}

// Velocities at t_k before step k, under the commands that were held.
void StepCommands::find_velocities(std::int64_t k) {
  stepper_.velocity_now(k, all(shown_), velocity_.data());
  if (k == 0) return;
  const double* before = stepper_.v();
  const double share = 2.0 / step_;
  for (std::size_t j = 0; j < velocity_.size(); ++j)
    acceleration_[j] = share * (velocity_[j] - before[j]);
}

}  // namespace rotorub
