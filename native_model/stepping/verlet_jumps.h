// Lasting contact in a step of `verlet` in which a load or the command jumps. In flight the mean
// over the step is all that counts. The contact's force is not part of the mean load: it ends, or
// its friction turns, where the load does. So the step's velocities are those that the loads before
// and the loads after would give had they held all along, each for its share s of the step,
//
//   v_{k+1/2} = s v_before + (1 - s) v_after,   (N, T) likewise,
//
// and order 2 stays. Where both only go on as they were, the mean load says the same, and the
// step ends on the circle.
#pragma once

#include <limits>
#include <utility>

#include "native_model/stepping/verlet_impacts.h"

namespace rotorub {

template <class M>
class VerletJumps : public VerletImpacts<M> {
  using Base = VerletImpacts<M>;

 public:
  using typename Base::Mask;
  using typename Base::T;
  static constexpr int kLanes = Base::kLanes;

  VerletJumps(const M& m, const std::vector<const Model*>& models, double h) : Base(m, models, h) {
    for (const Model* model : models) {
      const double first = next_switch(*model, 0.0, std::numeric_limits<double>::infinity());
      switched_ = switched_ || std::isfinite(first);
    }
  }

  // Of the lane's step that comes.
  void jump(int lane, const CommandJump& command) {
    commands_[lane] = command;
    command_jumps_ = command_jumps_ || command.share > 0.0;
  }

 protected:
  // What the step is to be done again from.
  struct Before {
    T in_contact{}, slip_sign{};
  };
  // Whether lanes in lasting contact have a jump between begin and end, s.
  ROTORUB_INLINE bool jumps(double begin, double end) {
    if (!switched_ && !command_jumps_) return false;
    if (!lanes::any(this->in_contact > T{})) return false;
    for (int lane = 0; lane < kLanes; ++lane) {
      const double share = share_before(lane, begin, end);
      if (share > kLeastPart && share < 1.0 - kLeastPart) return true;
    }
    return false;
  }
  // The step's end.
  ROTORUB_INLINE void forget_jumps() {
    if (!command_jumps_) return;
    for (CommandJump& command : commands_) command = {};
    command_jumps_ = false;
  }

  // free_ of the step's loads, which are those of its kick: the first is half of one.
  ROTORUB_INLINE void halve_first_kick() {
    if (this->first_ == 0.0) return;
    const T half = lanes::all<T>(0.5);
    for (int i = 0; i < this->layout().nq(); ++i) {
      this->free_[at(i)] = half * (this->start_[at(i)] + this->free_[at(i)]);
    }
  }

  // Once the step is taken with its mean loads.
  ROTORUB_SLOW void split(const Before& was, double begin, double end, T& pressed_normal,
                          T& pressed_friction) {
    const T zero{}, one = lanes::all<T>(1.0), half = lanes::all<T>(0.5);
    T share = zero;
    for (int lane = 0; lane < kLanes; ++lane) {
      lanes::set(share, lane, share_before(lane, begin, end));
    }
    const Mask on = (share > lanes::all<T>(kLeastPart)) &
                    (share < lanes::all<T>(1.0 - kLeastPart)) & (was.in_contact > zero);
    if (!lanes::any(on)) return;
    share = lanes::select(on, share, half);
    const T middle = lanes::all<T>(begin) + share * lanes::all<T>(end - begin);

    const int nq = this->layout().nq();
    const Contact mean = contact();
    const T mean_x = this->command_x, mean_y = this->command_y;
    for (int i = 0; i < nq; ++i) mean_after_[at(i)] = this->after_[at(i)];
    const Contact first = part(was, true, lanes::all<T>(begin), middle);
    for (int i = 0; i < nq; ++i) sum_[at(i)] = share * this->after_[at(i)];
    const Contact last = part({was.in_contact, first.slip_sign}, false, middle, lanes::all<T>(end));
    const T rest = one - share;
    for (int i = 0; i < nq; ++i) sum_[at(i)] += rest * this->after_[at(i)];

    const auto alike = [&](const Contact& c) {
      return (c.in_contact > zero) & (c.slip_sign == was.slip_sign);
    };
    const Mask other = on & !(alike(mean) & alike(first) & alike(last));
    const auto choose = [&](const T& a, const T& b, const T& whole) {
      return lanes::select(other, share * a + rest * b, whole);
    };
    this->normal_impulse = choose(first.normal, last.normal, mean.normal);
    this->friction_impulse = choose(first.friction, last.friction, mean.friction);
    this->in_contact = lanes::select(other, last.in_contact, mean.in_contact);
    this->slip_sign = lanes::select(other, last.slip_sign, mean.slip_sign);
    pressed_normal = lanes::select(other, last.normal, pressed_normal);
    pressed_friction = lanes::select(other, last.friction, pressed_friction);
    for (int i = 0; i < nq; ++i) {
      this->after_[at(i)] = lanes::select(other, sum_[at(i)], mean_after_[at(i)]);
    }
    // What works are reckoned from.
    this->command_x = mean_x;
    this->command_y = mean_y;
    free_under(lanes::all<T>(begin), lanes::all<T>(end));
  }

 private:
  // Of a step: below, round-off alone keeps the jump apart from the step's ends.
  static constexpr double kLeastPart = 1e-9;

  struct Contact {
    T normal{}, friction{}, in_contact{}, slip_sign{};
  };
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  Contact contact() const {
    return {this->normal_impulse, this->friction_impulse, this->in_contact, this->slip_sign};
  }

  // The whole step as if what holds from begin to end had held all along: after_ and the contact.
  Contact part(const Before& was, bool first, const T& begin, const T& end) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const CommandJump& c = commands_[lane];
      if (c.share == 0.0) continue;
      const Eigen::Vector2d& u = first ? c.before : c.after;
      lanes::set(this->command_x, lane, u.x());
      lanes::set(this->command_y, lane, u.y());
    }
    free_under(begin, end);
    for (int i = 0; i < this->layout().nq(); ++i) this->after_[at(i)] = this->free_[at(i)];
    this->normal_impulse = this->friction_impulse = T{};
    this->in_contact = was.in_contact;
    this->slip_sign = was.slip_sign;
    this->go_on(this->q_.data(), [] {});
    return contact();
  }

  void free_under(const T& begin, const T& end) {
    const double kick = std::exchange(this->kick_, 1.0);
    this->loads_.weigh(begin, end);
    this->weighed_free_velocity(begin, end, this->q_.data());
    halve_first_kick();
    this->kick_ = kick;
  }

  // Of the step; 1: all of it, there is no jump.
  double share_before(int lane, double begin, double end) const {
    if (commands_[lane].share > 0.0) return commands_[lane].share;
    return (next_switch(lane_model(*this->m_, lane), begin, end) - begin) / (end - begin);
  }

  bool switched_ = false, command_jumps_ = false;
  CommandJump commands_[kLanes];
  typename Base::Coordinates mean_after_ = Base::make(*this->m_), sum_ = Base::make(*this->m_);
};

}  // namespace rotorub
