// Lasting contact in a step of `verlet` in which a load or the command jumps. In flight the mean
// over the step is all that counts. The contact's force is not part of the mean load: it ends, or
// its friction turns, where the load does. So the step's velocities are those that the loads before
// and the loads after would give had they held all along, each for its share s of the step,
//
//   v_{k+1/2} = s v_before + (1 - s) v_after,   (N, T) likewise,
//
// and order 2 stays. Where both only go on as they were, the mean load says the same, and the
// step ends on the circle.
#include <algorithm>

#include "native_model/stepping/verlet_step.h"

namespace rotorub {

// Of the step; 1: all of it, there is no jump. Of commands that jump at several instants the first
// counts.
template <class M, class Contacts>
double VerletStep<M, Contacts>::share_before_jump(int lane, double begin, double end) const {
  constexpr double kNone = 2.0;
  double share = kNone;
  const int from = kLanes > 1 ? lane : 0, to = kLanes > 1 ? lane + 1 : kJumps;
  for (int i = from; command_jumps && i < to; ++i) {
    if (jumps[i].share > 0.0) share = std::min(share, jumps[i].share);
  }
  if (share < kNone) return share;
  return (next_switch(lane_model(x.m, lane), begin, end) - begin) / (end - begin);
}

// Once the step is taken with its mean loads.
template <class M, class Contacts>
void VerletStep<M, Contacts>::split(double begin, double end) {
  const Lasting& was = before_parts;
  const T zero{}, one = lanes::all<T>(1.0), half = lanes::all<T>(0.5);
  T share = zero;
  for (int lane = 0; lane < kLanes; ++lane) {
    lanes::set(share, lane, share_before_jump(lane, begin, end));
  }
  const Mask on = (share > lanes::all<T>(kLeastPart)) & (share < lanes::all<T>(1.0 - kLeastPart)) &
                  (contact.lasted(was) > zero);
  if (!lanes::any(on)) return;
  share = lanes::select(on, share, half);
  const T rest = one - share;
  const T from = lanes::all<T>(begin), to = lanes::all<T>(end), middle = from + share * (to - from);

  const StepCommands<T> mean_commands = loads.command;
  const Lasting mean = contact.now;
  mean_after = x.after;
  command_part(true, share);
  take_part(was, from, middle);
  const Lasting before = contact.now;
  for (std::size_t i = 0; i < part_sum.size(); ++i) part_sum[i] = share * x.after[i];
  command_part(false, share);
  take_part(contact.second_part(was, before), middle, to);
  for (std::size_t i = 0; i < part_sum.size(); ++i) part_sum[i] += rest * x.after[i];

  const Mask other = on & !(contact.alike(mean, was) & contact.alike(before, was) &
                            contact.alike(contact.now, was));
  contact.join_parts(other, share, rest, before, mean);
  for (std::size_t i = 0; i < part_sum.size(); ++i) {
    x.after[i] = lanes::select(other, part_sum[i], mean_after[i]);
  }
  // What works are reckoned from.
  loads.command = mean_commands;
  loads.free_velocity_of_part(x, from, to);
  if (was_first) halve_kick();
}

// The whole step as if what holds from begin to end had held all along: x.after and the contact.
template <class M, class Contacts>
void VerletStep<M, Contacts>::take_part(const Lasting& was, const T& begin, const T& end) {
  loads.free_velocity_of_part(x, begin, end);
  if (was_first) halve_kick();
  x.after = x.free;
  contact.now = was;
  contact.go_on(x, loads);
}

// Of commands that jump at another instant the mean.
template <class M, class Contacts>
void VerletStep<M, Contacts>::command_part(bool before, const T& share) {
  for (int i = 0; i < kJumps; ++i) {
    const int lane = kLanes > 1 ? i : 0;
    const std::size_t ring = kLanes > 1 ? 0 : at(i);
    if (jumps[i].share == 0.0 || jumps[i].share - lanes::get(share, lane) > kLeastPart) continue;
    const Eigen::Vector2d& u = before ? jumps[i].before : jumps[i].after;
    lanes::set(loads.command[ring].x, lane, u.x());
    lanes::set(loads.command[ring].y, lane, u.y());
  }
}

#define ROTORUB_DEFINE_STEP(...)                                                         \
  template double VerletStep<__VA_ARGS__>::share_before_jump(int, double, double) const; \
  template void VerletStep<__VA_ARGS__>::split(double, double);
#define ROTORUB_DEFINE(...) ROTORUB_DEFINE_STEP(__VA_ARGS__, OneContact<__VA_ARGS__>)
ROTORUB_ALL_MODELS(ROTORUB_DEFINE)
ROTORUB_DEFINE_STEP(Model, SeveralContacts)
#undef ROTORUB_DEFINE
#undef ROTORUB_DEFINE_STEP

}  // namespace rotorub
