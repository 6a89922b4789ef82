#include "native_model/stepping/verlet_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rotorub {
namespace {

// Below, of a step, round-off alone keeps a jump apart from the step's ends.
constexpr double kLeastPart = 1e-9;

bool impacts_take_time(const Model& m) {
  return m.first().contact && m.first().contact->impact_time() > 0.0;
}

}  // namespace

template <class Contacts>
VerletStep<Contacts>::VerletStep(const Model& model, double h)
    : x(model, h),
      loads(model, h),
      contact(x, loads),
      late_(x.q),
      switches_(std::isfinite(next_switch(model, 0.0, std::numeric_limits<double>::infinity()))),
      mean_after_(x.q),
      part_sum_(x.q) {
  if (kOne && impacts_take_time(model)) slow_impact_.emplace(model);
}

// ------------------------------------------------------------------ the step
template <class Contacts>
void VerletStep<Contacts>::step(std::int64_t k) {
  late_work_ = impact_time_ = 0.0;
  contact.forget_last();
  const bool later = loads.iterates() && !first_ && !slow_impact_ && contact.settles();
  x.begin(owes_ ? late_.data() : nullptr);
  kick(k, later);
  if (owes_) std::fill(late_.begin(), late_.end(), 0.0);
  owes_ = false;
  was_first_ = first_;
  held_open_ = slow_impact_ && slow_impact_->active();
  if (held_open_) {
    if constexpr (kOne) follow_slow_impact(k);
  } else if (contact.exists()) {
    const double end = x.time_of(k) + 0.5 * x.h, begin = was_first_ ? x.time_of(k) : end - x.h;
    const double share = share_before_jump(begin, end);
    if (share > 0.0) before_parts_ = contact.now;
    x.kick = was_first_ ? 0.5 : 1.0;
    const bool hits = contact.go_on(x, loads, later);
    if constexpr (kRigid) {
      if (share > 0.0) split(share, begin, end);
      if (hits) collide(k);
    }
    x.kick = 1.0;
  }
  if (command_jumps_) forget_jumps();
  first_ = false;
  x.move();
}

// x.free and x.after of step k without contact; `later`: see LoadKick.
template <class Contacts>
void VerletStep<Contacts>::kick(std::int64_t k, bool later) {
  const double t = x.time_of(k);
  loads.free_velocity(x, k, first_ ? t : t - 0.5 * x.h, t, later);
  if (first_) halve_kick();
}

// x.free of the step's loads, which are those of its kick: the first is half of one.
template <class Contacts>
void VerletStep<Contacts>::halve_kick() {
  for (std::size_t i = 0; i < x.free.size(); ++i) x.free[i] = 0.5 * (x.start[i] + x.free[i]);
  x.after = x.free;
}

template <class Contacts>
void VerletStep<Contacts>::velocity_now(std::int64_t k, double* now) {
  if (first_) {
    std::copy(x.v.begin(), x.v.end(), now);
    return;
  }
  x.look(owes_ ? late_.data() : nullptr);
  kick(k);
  if (slow_impact_ && slow_impact_->active()) return slow_impact_->velocities(x.time_of(k), now);
  if (contact.exists()) contact.hold_on(x, loads);
  for (std::size_t i = 0; i < x.free.size(); ++i) now[i] = 0.5 * (x.start[i] + x.free[i]);
}

template <class Contacts>
void VerletStep<Contacts>::restart() {
  first_ = true;
  owes_ = false;
  std::fill(late_.begin(), late_.end(), 0.0);
  loads.forget();
  if (slow_impact_) slow_impact_->cancel();
  contact.begin(x);
}

template <class Contacts>
void VerletStep<Contacts>::last_velocity(double* now) const {
  const double *start = x.start.data(), *end = contact.end_without_impacts(x);
  for (int i = 0; i < x.nq(); ++i) now[i] = was_first_ ? start[i] : 0.5 * (start[i] + end[i]);
  for (int i = x.m.sampled_states(); i < x.m.layout.coil(); ++i) now[i] = start[i];
  if (held_open_) slow_impact_->velocities(x.origin + last_time_, now);
}

template <class Contacts>
double VerletStep<Contacts>::external_work() {
  if (held_open_) return late_work_;  // the impact has it
  const double kick = was_first_ ? 0.5 : 1.0;
  return kick * loads.external_work(x, contact.end_without_impacts(x)) + late_work_;
}

// ------------------------------------------------------------------ jumps of loads and commands
// In flight the mean over the step is all that counts. In lasting contact the contact's force is
// not part of the mean load: it ends, or its friction turns, where the load does. So the step's
// velocities are those that the loads before and the loads after would give had they held all
// along, each for its share s of the step,
//
//   v_{k+1/2} = s v_before + (1 - s) v_after,   (N, T) likewise,
//
// and order 2 stays. Where both only go on as they were, the mean load says the same, and the step
// ends on the circle.
template <class Contacts>
void VerletStep<Contacts>::jump(std::size_t ring, const CommandJump& command) {
  jumps_[ring] = command;
  command_jumps_ = command_jumps_ || command.share > 0.0;
  if (command_jumps_) loads.jumps = jumps_;
}

template <class Contacts>
void VerletStep<Contacts>::forget_jumps() {
  jumps_.fill({});
  command_jumps_ = false;
  loads.jumps = {};
}

// The share of the kick from begin to end (s) before a load or a command jumps in lasting contact;
// 0: none does. Of commands that jump at several instants the first counts.
template <class Contacts>
double VerletStep<Contacts>::share_before_jump(double begin, double end) const {
  if (!(switches_ || command_jumps_) || !contact.lasts()) return 0.0;
  constexpr double kNone = 2.0;
  double share = kNone;
  for (const CommandJump& command : jumps_) {
    if (command_jumps_ && command.share > 0.0) share = std::min(share, command.share);
  }
  if (share == kNone) share = (next_switch(x.m, begin, end) - begin) / (end - begin);
  return share > kLeastPart && share < 1.0 - kLeastPart ? share : 0.0;
}

// Once the step is taken with its mean loads.
template <class Contacts>
void VerletStep<Contacts>::split(double share, double begin, double end) {
  if constexpr (kRigid) {
    const Lasting& was = before_parts_;
    const double rest = 1.0 - share, middle = begin + share * (end - begin);
    const LoadKick::Commands mean_commands = loads.command;
    const Lasting mean = contact.now;
    mean_after_ = x.after;
    command_part(true, share);
    take_part(was, begin, middle);
    const Lasting before = contact.now;
    for (std::size_t i = 0; i < part_sum_.size(); ++i) part_sum_[i] = share * x.after[i];
    command_part(false, share);
    take_part(contact.second_part(was, before), middle, end);
    for (std::size_t i = 0; i < part_sum_.size(); ++i) part_sum_[i] += rest * x.after[i];

    // The loads of the whole step again: x.free, and what works are reckoned from.
    loads.command = mean_commands;
    loads.free_velocity_of_part(x, begin, end);
    if (was_first_) halve_kick();
    if (contact.alike(mean, was) && contact.alike(before, was) && contact.alike(contact.now, was)) {
      contact.go_on_as(mean);
      x.after = mean_after_;
    } else {
      contact.join_parts(share, rest, before);
      x.after = part_sum_;
    }
  }
}

// The whole step as if what holds from begin to end had held all along: x.after and the contact.
template <class Contacts>
void VerletStep<Contacts>::take_part(const Lasting& was, double begin, double end) {
  loads.free_velocity_of_part(x, begin, end);
  if (was_first_) halve_kick();
  contact.now = was;
  contact.go_on(x, loads);
}

// Of commands that jump at another instant the mean.
template <class Contacts>
void VerletStep<Contacts>::command_part(bool before, double share) {
  for (std::size_t i = 0; i < jumps_.size(); ++i) {
    if (jumps_[i].share == 0.0 || jumps_[i].share - share > kLeastPart) continue;
    loads.command[i] = before ? jumps_[i].before : jumps_[i].after;
  }
}

template class VerletStep<OneContact>;
template class VerletStep<SeveralContacts>;
template class VerletStep<CompliantContacts>;

}  // namespace rotorub
