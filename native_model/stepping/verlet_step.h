// One step of `verlet`: leapfrog, order 2 through impacts, their accumulation and lasting contact.
// The velocity that goes with q_k is that of half a step before, v_{k-1/2}.
//
//   1. v' = v_{k-1/2} + what the last step's impacts left over; free velocity v_f = v_{k+1/2} from
//   all
//      loads at (t_k, q_k), velocity-dependent ones at the mean of v' and v_f. The first step is
//      half a kick.
//   2. The straight path q_k + h v_f stays in the ring: done.
//   3. It leaves the circle, out of flight: Poisson's law where it does (verlet_impacts.h).
//   4. Lasting contact: the step ends on the circle (contact/step_contact.h); where a load or
//   the
//      command jumps within it, verlet_jumps.h.
#pragma once

#include "native_model/stepping/verlet_jumps.h"

namespace rotorub {

template <class M>
class VerletKernel : public VerletJumps<M> {
  using Base = VerletJumps<M>;

 public:
  using typename Base::Centre;
  using typename Base::Mask;
  using typename Base::T;
  static constexpr int kLanes = Base::kLanes;

  using Base::Base;

  // A state (q, v at one instant) has been written: the next step is half a kick. On the circle and
  // not closing it is in lasting contact.
  void restart() {
    this->first_ = 1.0;
    this->owes_ = 0.0;
    for (T& x : this->late_) x = T{};
    this->in_contact = this->slip_sign = T{};
    this->loads_.forget();
    for (FiniteImpact& impact : this->lasting_) impact.cancel();
    if (!this->contact_) return;
    for (int lane = 0; lane < kLanes; ++lane) {
      const Model& m = lane_model(*this->m_, lane);
      double q[kMaxCoordinates], v[kMaxCoordinates];
      this->read_lane(this->q_.data(), lane, q);
      this->read_lane(this->v_.data(), lane, v);
      const ContactPoint p = contact_point(m, q, v);
      const double clearance = m.first().contact->clearance;
      if (p.gap > 1e-12 * clearance || p.gap_rate < -1e-9) continue;
      lanes::set(this->in_contact, lane, p.gap_rate > 1e-9 ? 0.0 : 1.0);
    }
  }

  // From t_k = origin + k h to t_{k+1}. A lane with a status stays where it was.
  ROTORUB_INLINE void step(std::int64_t k) {
    const int nq = this->layout().nq();
    const T* q = this->q_.data();
    T* after = this->after_.data();
    if (this->impacted_ || this->takes_time_) this->late_work = 0.0;
    if (this->takes_time_) std::fill_n(this->impact_time, kLanes, 0.0);
    this->forget_last();
    kick(k);
    for (int i = 0; i < nq; ++i) {
      const auto c = static_cast<std::size_t>(i);
      after[i] = this->free_[c];
      before_[c] = q[i];
    }
    if (this->owes_ > 0.0) {
      for (T& x : this->late_) x = T{};
      this->owes_ = 0.0;
    }
    this->was_first_ = this->first_ > 0.0;
    if (this->takes_time_) this->find_lasting();
    if (this->contact_) {
      const double end = time_of(k) + 0.5 * this->h_,
                   begin = this->was_first_ ? time_of(k) : end - this->h_;
      const typename Base::Before was{this->in_contact, this->slip_sign};
      const bool jumps = this->jumps(begin, end);
      this->kick_ = this->was_first_ ? 0.5 : 1.0;
      pressed_normal_ = pressed_friction_ = T{};
      this->touch(
          q, [&](int lane) { this->collide(lane, k); },
          [&] {
            pressed_normal_ = this->normal_impulse;
            pressed_friction_ = this->friction_impulse;
          });
      if (jumps) this->split(was, begin, end, pressed_normal_, pressed_friction_);
      if (this->impact_lasts_) this->go_on_lasting(k);
      this->kick_ = 1.0;
    }
    this->forget_jumps();
    this->first_ = 0.0;
    this->move(before_.data(), lanes::all<T>(this->h_));
  }

  // The velocities of t_k before step k: v_{k-1/2} + h/2 a(t_k-), with the command as it stands and
  // the contact force of the step before. For controllers, which see them before there is a
  // command.
  ROTORUB_INLINE void velocity_now(std::int64_t k, T* now) {
    const int nq = this->layout().nq();
    if (this->first_ > 0.0) {
      for (int i = 0; i < nq; ++i) now[i] = this->v_[static_cast<std::size_t>(i)];
      return;
    }
    kick(k);
    if (this->takes_time_) this->find_lasting();
    if (this->contact_ && lanes::any(this->in_contact > T{})) {
      const Centre d = equations::separation(*this->m_, this->q_.data());
      const T one = lanes::all<T>(1.0), square = d.x * d.x + d.y * d.y;
      const T delta = lanes::square_root(lanes::select(square > T{}, square, one));
      if (this->coupled_) this->respond();
      this->push(this->free_.data(), this->free_.data(), d.x / delta, d.y / delta, pressed_normal_,
                 pressed_friction_, this->in_contact > T{});
    }
    const T half = lanes::all<T>(0.5);
    for (int i = 0; i < nq; ++i) {
      const auto c = static_cast<std::size_t>(i);
      now[i] = half * (this->start_[c] + this->free_[c]);
    }
    if (!this->impact_lasts_) return;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (lanes::get(this->flying_, lane) == 0.0) this->show_lasting(lane, k, now);
    }
  }
  // After step k: coordinates and velocities of t_k. Velocities are the mean of the two middles,
  // just before an impact of the step.
  const T* last_q() const { return before_.data(); }
  void velocity_of_last(T* now) const {
    const T half = lanes::all<T>(0.5);
    for (std::size_t i = 0; i < this->late_.size(); ++i) {
      now[i] = this->was_first_ ? this->start_[i] : half * (this->start_[i] + end_of_last()[i]);
    }
    if (this->impact_lasts_) this->lasting_[0].velocities(this->origin + this->last_time_, now);
  }
  // m/s, of t_k, of lanes whose contact lasted over step k; of the others any number.
  ROTORUB_INLINE T slip_of_last() const {
    const M& m = *this->m_;
    Centre w = equations::relative(m, this->start_.data());
    T spin = equations::contact_spin(m, this->start_.data());
    if (!this->was_first_) {
      const T half = lanes::all<T>(0.5);
      const Centre end = equations::relative(m, this->after_.data());
      w.x = half * (w.x + end.x);
      w.y = half * (w.y + end.y);
      spin = half * (spin + equations::contact_spin(m, this->after_.data()));
    }
    return this->slip_of(w, spin);
  }
  bool was_first() const { return this->was_first_; }
  // The step's works on the coordinates, J; alone (one lane).
  double external_work_of_last() requires(Base::kLanes == 1) {
    if (this->impact_lasts_) return this->late_work;  // the impact has it
    const double kick = this->was_first_ ? 0.5 : 1.0;
    return kick * this->external_work(before_.data(), this->start_.data(), end_of_last()) +
           this->late_work;
  }
  double contact_work_of_last() const requires(Base::kLanes == 1) {
    if (this->impacted_) return this->impact_work(this->impacts[0]);
    return this->contact_work(this->start_.data(), this->after_.data());
  }

  // As the base's.
  template <class Action>
  void for_each_kept(Action action) {
    Base::for_each_kept(action);
    action(this->first_);
    action(pressed_normal_);
    action(pressed_friction_);
    action(this->owes_);
    for (T& x : this->late_) action(x);
    for (FiniteImpact& impact : this->lasting_) impact.for_each_kept(action);
  }
  void begin(double t, const double* q, const double* v) requires(Base::kLanes == 1) {
    Base::begin(t, q, v);
    restart();
  }

 private:
  const T* end_of_last() const {
    return this->impacted_ ? this->free_.data() : this->after_.data();
  }

  // start_ and free_ of step k.
  ROTORUB_INLINE void kick(std::int64_t k) {
    const int nq = this->layout().nq();
    T* start = this->start_.data();
    for (int i = 0; i < nq; ++i) start[i] = this->v_[static_cast<std::size_t>(i)];
    if (this->owes_ > 0.0) {
      for (int i = 0; i < nq; ++i) start[i] += this->late_[static_cast<std::size_t>(i)];
    }
    const double t = time_of(k);
    this->free_velocity(k, this->first_ > 0.0 ? t : t - 0.5 * this->h_, t, this->q_.data());
    this->halve_first_kick();
  }
  double time_of(std::int64_t k) const { return this->origin + static_cast<double>(k) * this->h_; }

  typename Base::Coordinates before_ = Base::make(*this->m_);  // q_k
  T pressed_normal_{}, pressed_friction_{};                    // N s, of lasting contact alone
};

}  // namespace rotorub
