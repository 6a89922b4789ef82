// The magnetic bearings in a fixed step (load_kick.h): the fraction of the step in which each one
// works, and the sampled controls, whose commands and states jump at the samples.
#include <algorithm>

#include "native_model/model/sampled_feedback.h"
#include "native_model/stepping/load_kick.h"

namespace rotorub {

namespace eq = equations;

// The memory of the samplers jumps at t, which is the middle of the kick or, for a first half kick,
// its start. The mean of the kick's velocities then contains half of the jump, or all of it.
void LoadKick::find_samples(const StepState& state, double t, double begin) {
  double after[kMaxCoordinates];
  const double* v = state.v_start.data();
  const int first = m_.layout.feedback_state();
  const double share = begin == t ? 1.0 : 0.5;  // of the kick after the sample
  std::copy_n(v, state.nq(), after);
  sampled_now_ = take_samples(m_, t, state.h, state.q_k.data(), after);
  for (int i = 0; i < m_.layout.feedback_states; ++i) {
    const double change = 2.0 * share * (after[first + i] - v[first + i]);
    sampled_[static_cast<std::size_t>(i)] = m_.mass[first + i] * change / state.h;
  }
  for (std::size_t k = 0; k < m_.feedbacks.size(); ++k) {
    const int at = m_.feedbacks[k].states.command;
    if (at == kAbsent) continue;
    for (int axis = 0; axis < 2; ++axis) {
      AxisCommand& c = commands_[k][static_cast<std::size_t>(axis)];
      c.before = v[at + axis];
      c.after = after[at + axis];
      c.mean = c.before + share * (c.after - c.before);
    }
  }
}

void LoadKick::add_samples(double* f) const {
  for (int i = 0; i < m_.layout.feedback_states; ++i) {
    f[m_.layout.feedback_state() + i] += sampled_[static_cast<std::size_t>(i)];
  }
  for (std::size_t k = 0; k < m_.feedbacks.size(); ++k) {
    const StationFeedback& bearing = m_.feedbacks[k];
    const auto& [x, y] = commands_[k];
    if (bearing.states.command == kAbsent) continue;
    if (const int at = bearing.states.current; at != kAbsent) {
      f[at] += m_.mass[at] * x.rate;
      f[at + 1] += m_.mass[at + 1] * y.rate;
    } else {
      eq::add_station_force(m_.layout.modes, bearing.shape, x.force, y.force, f);
    }
  }
}

void LoadKick::find_working(const StepState& state, double begin, double end) {
  for (std::size_t k = 0; k < m_.feedbacks.size(); ++k) {
    working_[k] = m_.feedbacks[k].works.share(begin, end);
  }
  if (sampled_now_) find_switched(state, begin, end);
}

void LoadKick::find_switched(const StepState& state, double begin, double end) {
  const double sample = std::clamp(instant_, begin, end);
  for (std::size_t k = 0; k < m_.feedbacks.size(); ++k) {
    const StationFeedback& bearing = m_.feedbacks[k];
    if (bearing.states.command == kAbsent) continue;
    const MagneticFeedback& law = bearing.law;
    const double share = working_[k];
    const double share_before =
        bearing.works.share(begin, sample) * (sample - begin) / (end - begin);
    const double share_after = share - share_before;
    const eq::Pair r = eq::at_station(m_.layout.modes, bearing.shape, state.q_k.data());
    for (int axis = 0; axis < 2; ++axis) {
      AxisCommand& c = commands_[k][static_cast<std::size_t>(axis)];
      const double place = axis == 0 ? r.x : r.y;
      c.force = c.rate = 0.0;
      if (c.before == c.after) continue;
      if (const int at = bearing.states.current; at != kAbsent) {
        const double current = state.v_start[static_cast<std::size_t>(at + axis)];
        const auto load = [&](double asked) { return law.amplifier.load(asked, current); };
        c.rate =
            (share_before * load(c.before) + share_after * load(c.after) - share * load(c.mean)) /
            law.amplifier.lag;
      } else {
        c.force = law.force(share_before, place, c.before) +
                  law.force(share_after, place, c.after) - law.force(share, place, c.mean) -
                  law.linear_spring * place;
      }
    }
  }
}

}  // namespace rotorub
