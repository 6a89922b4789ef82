// One step of `verlet`: leapfrog, order 2 through impacts, their accumulation and lasting contact.
// The velocity that goes with q_k is that of half a step before, v_{k-1/2}.
//
//   1. v' = v_{k-1/2} + what the last step's impacts left over; free velocity v_f = v_{k+1/2} from all
//      loads at (t_k, q_k), velocity-dependent ones at the mean of v' and v_f. The first step is half
//      a kick.
//   2. The straight path q_k + h v_f stays in the ring: done.
//   3. It leaves the circle, out of flight: Poisson's law where it does, at the share theta of the step
//      (contact/located_impact.h). Of the jump w of the velocities this step takes (1 - theta) w, the
//      next one the rest, and what the loads that depend on velocities miss of it,
//      -(theta - 1/2) h M^-1 (F(v + w) - F(v)); without that term order 2 is lost.
//   4. Lasting contact: the step ends on the circle (contact/lasting_contact.h).
#pragma once

#include "native_model/contact/located_impact.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/stepping/contact_kernel.h"

namespace rotorub {

template <class M>
class VerletKernel : public ContactKernel<M> {
  using Base = ContactKernel<M>;

 public:
  using typename Base::Centre;
  using typename Base::Mask;
  using typename Base::T;
  static constexpr int kLanes = Base::kLanes;

  VerletKernel(const M& m, const std::vector<const Model*>& models, double h)
      : Base(m, models, h) {}

  // J, of the impacts of the step: what the mean of the step's velocities misses of the loads' work.
  double late_work = 0.0;

  // A state (q, v at one instant) has been written: the next step is half a kick. On the circle and
  // not closing it is in lasting contact.
  void restart() {
    first_ = 1.0;
    owes_ = 0.0;
    for (T& x : late_) x = T{};
    this->in_contact = this->slip_sign = T{};
    this->loads_.forget();
    if (!this->contact_) return;
    for (int lane = 0; lane < kLanes; ++lane) {
      const Model& m = lane_model(*this->m_, lane);
      double q[kMaxCoordinates], v[kMaxCoordinates];
      this->read_lane(this->q_.data(), lane, q);
      this->read_lane(this->v_.data(), lane, v);
      const ContactPoint p = contact_point(m, q, v);
      const double clearance = m.contact->clearance;
      if (p.gap > 1e-12 * clearance || p.gap_rate < -1e-9) continue;
      lanes::set(this->in_contact, lane, p.gap_rate > 1e-9 ? 0.0 : 1.0);
    }
  }

  // From t_k = origin + k h to t_{k+1}. A lane with a status stays where it was.
  ROTORUB_INLINE void step(std::int64_t k) {
    const int nq = this->layout().nq();
    const T* q = this->q_.data();
    T* after = this->after_.data();
    if (this->impacted_) late_work = 0.0;
    this->forget_last();
    kick(k);
    for (int i = 0; i < nq; ++i) {
      const auto c = static_cast<std::size_t>(i);
      after[i] = this->free_[c];
      before_[c] = q[i];
    }
    if (owes_ > 0.0) {
      for (T& x : late_) x = T{};
      owes_ = 0.0;
    }
    was_first_ = first_ > 0.0;
    if (this->contact_) {
      pressed_normal_ = pressed_friction_ = T{};
      this->touch(q, [&](int lane) { collide(lane, k); },
                  [&] {
                    pressed_normal_ = this->normal_impulse;
                    pressed_friction_ = this->friction_impulse;
                  });
    }
    first_ = 0.0;
    this->move(before_.data(), lanes::all<T>(this->h_));
  }

  // The velocities of t_k before step k: v_{k-1/2} + h/2 a(t_k-), with the command as it stands and the
  // contact force of the step before. For controllers, which see them before there is a command.
  ROTORUB_INLINE void velocity_now(std::int64_t k, T* now) {
    const int nq = this->layout().nq();
    if (first_ > 0.0) {
      for (int i = 0; i < nq; ++i) now[i] = this->v_[static_cast<std::size_t>(i)];
      return;
    }
    kick(k);
    if (this->contact_ && lanes::any(this->in_contact > T{})) {
      const Centre d = equations::relative(*this->m_, this->q_.data());
      const T one = lanes::all<T>(1.0), square = d.x * d.x + d.y * d.y;
      const T delta = lanes::square_root(lanes::select(square > T{}, square, one));
      if (this->coupled_) this->respond();
      this->push(this->free_.data(), this->free_.data(), d.x / delta, d.y / delta, pressed_normal_, pressed_friction_,
                 this->in_contact > T{});
    }
    const T half = lanes::all<T>(0.5);
    for (int i = 0; i < nq; ++i) {
      const auto c = static_cast<std::size_t>(i);
      now[i] = half * (this->start_[c] + this->free_[c]);
    }
  }
  // After step k: coordinates and velocities of t_k. Velocities are the mean of the two middles, just
  // before an impact of the step.
  const T* last_q() const { return before_.data(); }
  void velocity_of_last(T* now) const {
    const T half = lanes::all<T>(0.5);
    for (std::size_t i = 0; i < late_.size(); ++i) {
      now[i] = was_first_ ? this->start_[i] : half * (this->start_[i] + end_of_last()[i]);
    }
  }
  bool was_first() const { return was_first_; }
  // The step's works on the coordinates, J; alone (one lane).
  double external_work_of_last()
    requires(Base::kLanes == 1)
  {
    const double kick = was_first_ ? 0.5 : 1.0;
    return kick * this->external_work(before_.data(), this->start_.data(), end_of_last()) + late_work;
  }
  double contact_work_of_last() const
    requires(Base::kLanes == 1)
  {
    if (this->impacted_) return this->impact_work(this->impacts[0]);
    return this->contact_work(this->start_.data(), this->after_.data());
  }

  // As the base's.
  template <class Action>
  void for_each_kept(Action action) {
    Base::for_each_kept(action);
    action(first_);
    action(pressed_normal_);
    action(pressed_friction_);
    action(owes_);
    for (T& x : late_) action(x);
  }
  void begin(double t, const double* q, const double* v)
    requires(Base::kLanes == 1)
  {
    Base::begin(t, q, v);
    restart();
  }

 private:
  const T* end_of_last() const { return this->impacted_ ? this->free_.data() : this->after_.data(); }

  // start_ and free_ of step k.
  ROTORUB_INLINE void kick(std::int64_t k) {
    const int nq = this->layout().nq();
    T *start = this->start_.data(), *free = this->free_.data();
    for (int i = 0; i < nq; ++i) start[i] = this->v_[static_cast<std::size_t>(i)];
    if (owes_ > 0.0) {
      for (int i = 0; i < nq; ++i) start[i] += late_[static_cast<std::size_t>(i)];
    }
    const double t = this->origin + static_cast<double>(k) * this->h_;
    this->free_velocity(k, first_ > 0.0 ? t : t - 0.5 * this->h_, t, this->q_.data());
    if (first_ == 0.0) return;
    const T half = lanes::all<T>(0.5);
    for (int i = 0; i < nq; ++i) free[i] = half * (start[i] + free[i]);
  }

  // The impacts of one lane.
  ROTORUB_SLOW void collide(int lane, std::int64_t k) {
    const Model& m = lane_model(*this->m_, lane);
    const ContactParameters& c = *m.contact;
    const int nq = m.nq();
    const double h = this->h_, kick = was_first_ ? 0.5 * h : h;
    const double t = this->origin + static_cast<double>(k) * h;
    double q[kMaxCoordinates], start[kMaxCoordinates], v[kMaxCoordinates];
    this->read_lane(this->q_.data(), lane, q);
    this->read_lane(this->start_.data(), lane, start);
    this->read_lane(this->free_.data(), lane, v);

    FlightStep s;
    s.h = h;
    s.d = rotor_point(m, q) - stator_point(m, q);
    s.velocity = this->lane_rates(this->free_.data(), lane);
    s.acceleration = (s.velocity - this->lane_rates(this->start_.data(), lane)) / kick;
    s.clearance = c.clearance;
    s.radius = c.radius;
    if (m.coupled_mass()) {  // M(phi) of the impact
      const double share = circle_exit(s.d, h * s.velocity.head<2>(), c.clearance);
      for (int i = 0; i < nq; ++i) q[i] += std::min(1.0, share) * h * v[i];
    }
    s.admittance = contact_admittance(m, t, q);
    const StepImpacts hits =
        locate_impacts(s, {c.friction, c.restitution, c.tangential_restitution});
    if (hits.status != ImpactStatus::kOk) {
      return this->fail(lane, hits.status == ImpactStatus::kNoSolution ? Status::kNoSolution
                                                                       : Status::kAmbiguous);
    }
    for (int i = 0; i < nq; ++i) start[i] = (v[i] - start[i]) / kick;  // acceleration, from here on
    const Eigen::Vector2d u{lanes::get(this->command_x, lane), lanes::get(this->command_y, lane)};
    for (int n = 0; n < hits.count; ++n) {
      apply(lane, m, t, q, v, start, u, hits.impacts[static_cast<std::size_t>(n)]);
    }
    lanes::set(this->in_contact, lane, hits.closes ? 1.0 : 0.0);
    lanes::set(this->slip_sign, lane, 0.0);
  }

  // v: the velocities of the step's middle, this impact's jump is added; a: accelerations.
  void apply(int lane, const Model& m, double t, const double* q, double* v, const double* a,
             const Eigen::Vector2d& u, const LocatedImpact& hit) {
    const int nq = m.nq();
    const double h = this->h_, theta = hit.theta, late = (theta - 0.5) * h;
    const double normal = hit.law.normal(), friction = hit.law.friction();
    double jump[kMaxCoordinates], at[kMaxCoordinates], before[kMaxCoordinates],
        missed[kMaxCoordinates];
    std::fill_n(jump, nq, 0.0);
    add_contact_load(m, contact_load(hit.e_r, m.contact->radius, normal, friction), jump);
    solve_mass(m, t, q, jump, jump);
    // The loads by the velocities just before and just after.
    for (int i = 0; i < nq; ++i) at[i] = v[i] + late * a[i];
    // A continuous controller sees the jump too.
    const bool follows = m.controller && m.sample_time == 0.0 && t >= m.control_on;
    const auto command = [&] { return follows ? control_command(m, t, q, at) : u; };
    Eigen::Vector2d told = command();
    smooth_force(m, t, q, at, told, before);
    const double power = external_power(m, t, q, at, actuator_state(m, q, at, told).force);
    for (int i = 0; i < nq; ++i) at[i] += jump[i];
    told = command();
    smooth_force(m, t, q, at, told, missed);
    late_work -=
        late * (external_power(m, t, q, at, actuator_state(m, q, at, told).force) - power);
    for (int i = 0; i < nq; ++i) missed[i] = -late * (missed[i] - before[i]);
    solve_mass(m, t, q, missed, missed);

    const auto add = [lane](T& to, double x) { lanes::set(to, lane, lanes::get(to, lane) + x); };
    for (int i = 0; i < nq; ++i) {
      const auto c = static_cast<std::size_t>(i);
      v[i] += jump[i];
      add(this->after_[c], (1.0 - theta) * jump[i]);
      add(late_[c], theta * jump[i] + missed[i]);
    }
    add(this->normal_impulse, normal);
    add(this->friction_impulse, friction);
    owes_ = 1.0;
    this->impacted_ = true;
    this->impacts[static_cast<std::size_t>(lane)].add({t + theta * h, normal, friction, hit.gap_rate_before, hit.law.gap_rate,
                       hit.slip_before, hit.law.slip,
                       0.5 * (normal * (hit.gap_rate_before + hit.law.gap_rate) +
                              friction * (hit.slip_before + hit.law.slip))});
  }

  typename Base::Coordinates late_ = Base::make(*this->m_);  // m/s, rad/s: velocities that impacts of the last step left over
  typename Base::Coordinates before_ = late_;  // q_k
  T pressed_normal_{}, pressed_friction_{};  // N s, of lasting contact alone
  double first_ = 1.0, owes_ = 0.0;  // 1: the next step is half a kick; late_ holds something
  bool was_first_ = true;
};

}  // namespace rotorub
