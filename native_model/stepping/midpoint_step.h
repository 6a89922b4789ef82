// One step of `midpoint`: the loads act at the middle of the step, q_m = q + h/2 v, v+ from the
// forces at (t + h/2, q_m), q+ = q_m + h/2 v+; the contact's normal is that at q_m and lasting
// contact ends on the circle at the next middle (SHAKE on the midpoints). An impact is not located:
// order 1.
#pragma once

#include <cmath>

#include "native_model/contact/impact.h"
#include "native_model/contact/kinematics.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/stepping/contact_kernel.h"

namespace rotorub {

template <class M>
class MidpointKernel : public ContactKernel<M> {
  using Base = ContactKernel<M>;

 public:
  using typename Base::Centre;
  using typename Base::Mask;
  using typename Base::T;
  static constexpr int kLanes = Base::kLanes;

  MidpointKernel(const M& m, const std::vector<const Model*>& models, double h)
      : Base(m, models, h) {}

  // The state of the last step's middle that contact and loads saw, and its velocities.
  const T* middle() const { return middle_.data(); }

  // m/s, as the step ended; 0 at the centre, where there is no direction.
  ROTORUB_INLINE T slip_of_last() const {
    const M& m = *this->m_;
    const T *q = this->q_.data(), *v = this->v_.data();
    const Centre d = equations::separation(m, q), w = equations::relative(m, v);
    const T zero{}, one = lanes::all<T>(1.0), square = d.x * d.x + d.y * d.y;
    const T delta = lanes::square_root(lanes::select(square > zero, square, one));
    return (d.x * w.y - d.y * w.x) / delta + this->contact.radius * equations::contact_spin(m, v);
  }

  // The step's works on the coordinates, J; alone (one lane).
  double external_work_of_last() requires(Base::kLanes == 1) {
    return this->external_work(middle_.data(), this->start_.data(), this->after_.data());
  }
  double contact_work_of_last() const requires(Base::kLanes == 1) {
    if (this->impacted_) return this->impact_work(this->impacts[0]);
    return this->contact_work(this->start_.data(), this->after_.data());
  }

  // From t = origin + k h to origin + (k + 1) h. A lane with a status stays where it was.
  ROTORUB_INLINE void step(std::int64_t k) {
    const int nq = this->layout().nq();
    const T half = lanes::all<T>(0.5 * this->h_);
    const T *q = this->q_.data(), *v = this->v_.data();
    T *middle = middle_.data(), *start = this->start_.data(), *after = this->after_.data();
    for (int i = 0; i < nq; ++i) {
      middle[i] = q[i] + half * v[i];
      start[i] = v[i];
    }
    this->forget_last();

    if (this->contact_) back_to_circle();
    const double t = this->origin + static_cast<double>(k) * this->h_;
    this->free_velocity(k, t, t + 0.5 * this->h_, middle);
    for (int i = 0; i < nq; ++i) after[i] = this->free_[static_cast<std::size_t>(i)];
    if (this->contact_) {
      this->touch(
          middle, [&](int lane) { collide(lane, k); }, [] {});
    }
    this->move(middle, half);
  }

 private:
  // A middle well outside the ring (a flight of more than the clearance within half a step) goes
  // back to the circle, by the least change in the norm of A. Left to lasting contact, the depth
  // would come back as speed.
  ROTORUB_INLINE void back_to_circle() {
    const Centre d = equations::separation(*this->m_, middle_.data());
    const T square = d.x * d.x + d.y * d.y, c = this->contact.clearance;
    const Mask outside = square > c * c * lanes::all<T>(1.02);
    if (!lanes::any(outside)) return;
    if (this->coupled_) this->respond();
    const T one = lanes::all<T>(1.0);
    const T delta = lanes::select(outside, lanes::square_root(square), one);
    const T ex = d.x / delta, ey = d.y / delta;
    const auto& a = this->admittance_.a;
    const T nn = ex * (a[0][0] * ex + a[0][1] * ey) + ey * (a[1][0] * ex + a[1][1] * ey);
    this->push(middle_.data(), middle_.data(), ex, ey, (delta - c) / nn, T{}, outside);
  }

  // Poisson's law in one lane where the contact closes. Without a flight after it
  // (contact/impact.h) the middle closes the gap, by the least change in the norm of M, and
  // contact lasts.
  ROTORUB_SLOW void collide(int lane, std::int64_t k) {
    const Model& m = lane_model(*this->m_, lane);
    const ContactParameters& c = *m.first().contact;
    double q[kMaxCoordinates], change[kMaxCoordinates];
    this->read_lane(middle_.data(), lane, q);
    const Eigen::Vector2d d = separation(m, q);
    const Eigen::Vector3d free = this->lane_rates(this->free_.data(), lane);
    const Eigen::Vector3d start = this->lane_rates(this->start_.data(), lane);
    const Eigen::Vector2d e_r = normal_of_path(d, this->h_ * free.head<2>(), c.clearance);
    const Eigen::Vector3d acceleration = (free - start) / this->h_;
    const double pressed = pressing(e_r, free, acceleration, c.clearance);
    const double closing = e_r.dot(free.head<2>());
    const bool stays = !rebound_outlives_steps(this->h_, c.restitution, closing, pressed);
    if (!(closing > 0.0)) return;
    const double t = this->origin + (static_cast<double>(k) + 0.5) * this->h_;
    const Delassus g = delassus(contact_admittance(m, t, q), e_r, c.radius);
    if (stays) {
      std::fill_n(change, m.nq(), 0.0);
      add_contact_load(m, contact_load(e_r, 0.0, -(c.clearance - e_r.dot(d)) / g.nn, 0.0), change);
      solve_mass(m, t, q, change, change);
      for (int i = 0; i < m.nq(); ++i) {
        lanes::set(middle_[static_cast<std::size_t>(i)], lane, q[i] + change[i]);
      }
      lanes::set(this->in_contact, lane, 1.0);
    }
    const double slip = e_r.x() * free.y() - e_r.y() * free.x() + c.radius * free.z();
    ImpactLaw law = c.law();
    if (stays) law.restitution = law.tangential_restitution = 0.0;
    const ImpactResult r = solve_impact(g, -closing, slip, law);
    if (r.status != Status::kOk) return this->fail(lane, r.status);
    std::fill_n(change, m.nq(), 0.0);
    add_contact_load(m, contact_load(e_r, c.radius, r.normal(), r.friction()), change);
    solve_mass(m, t, q, change, change);
    for (int i = 0; i < m.nq(); ++i) {
      T& to = this->after_[static_cast<std::size_t>(i)];
      lanes::set(to, lane, lanes::get(to, lane) + change[i]);
    }
    lanes::set(this->normal_impulse, lane, r.normal());
    lanes::set(this->friction_impulse, lane, r.friction());
    note(lane, k, d, free,
         {0.0, r.normal(), r.friction(), -closing, r.gap_rate, slip, r.slip, 0.0});
  }

  void note(int lane, std::int64_t k, const Eigen::Vector2d& d, const Eigen::Vector3d& free,
            Impact impact) {
    const double clearance = lane_model(*this->m_, lane).first().contact->clearance;
    const double share = std::min(0.5, circle_exit(d, this->h_ * free.head<2>(), clearance));
    impact.t = this->origin + (static_cast<double>(k) + 0.5 + share) * this->h_;
    impact.energy_change =
        0.5 * (impact.normal_impulse * (impact.gap_rate_before + impact.gap_rate_after) +
               impact.friction_impulse * (impact.slip_before + impact.slip_after));
    this->impacts[static_cast<std::size_t>(lane)].add(impact);
    this->impacted_ = true;
  }

  typename Base::Coordinates middle_ = Base::make(*this->m_);
};

}  // namespace rotorub
