// One step of `paper`: the loads act at the middle of the step, q_m = q + h/2 v, v+ from the forces at
// (t + h/2, q_m), q+ = q_m + h/2 v+; the contact's normal is that at q_m and lasting contact ends on
// the circle at the next middle (SHAKE on the midpoints). An impact is not located: order 1.
#pragma once

#include <cmath>

#include "native_model/contact/located_impact.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/stepping/step_kernel.h"

namespace rotorub {

template <class M>
class PaperKernel : public StepKernel<M> {
  using Base = StepKernel<M>;

 public:
  using typename Base::Centre;
  using typename Base::Mask;
  using typename Base::T;
  static constexpr int kLanes = Base::kLanes;

  PaperKernel(const M& m, const std::vector<const Model*>& models, double h)
      : Base(m, models, h), middle_(static_cast<std::size_t>(m.layout.nq()), T{}) {}

  ImpactList impacts[kLanes];
  bool any_impact() const { return impacted_; }
  // The state of the last step's middle that contact and loads saw, and its velocities.
  const T* middle() const { return middle_.data(); }

  // The step's works on the coordinates, J; alone (one lane).
  double external_work_of_last()
    requires(Base::kLanes == 1)
  {
    return this->external_work(middle_.data(), this->start_.data(), this->after_.data());
  }
  double contact_work_of_last() const
    requires(Base::kLanes == 1)
  {
    if (impacted_) return this->impact_work(impacts[0]);
    return this->contact_work(this->start_.data(), this->after_.data());
  }

  // From t = origin + k h to origin + (k + 1) h. A lane with a status stays where it was.
  ROTORUB_INLINE void step(std::int64_t k) {
    const int nq = this->layout_.nq();
    const T half = lanes::all<T>(0.5 * this->h_), zero{};
    T *q = this->q_.data(), *v = this->v_.data(), *middle = middle_.data();
    for (int i = 0; i < nq; ++i) {
      middle[i] = q[i] + half * v[i];
      this->start_[static_cast<std::size_t>(i)] = v[i];
    }
    this->normal_impulse = this->friction_impulse = zero;
    if (impacted_) forget_impacts();

    if (this->contact_) back_to_circle();
    const double t = this->origin + static_cast<double>(k) * this->h_;
    this->free_velocity(k, t, t + 0.5 * this->h_, middle);
    T* after = this->after_.data();
    for (int i = 0; i < nq; ++i) after[i] = this->free_[static_cast<std::size_t>(i)];
    if (this->contact_) touch(k);

    this->check_finite(after);
    if (this->failed_) {
      const Mask moves = this->running() > zero;
      for (int i = 0; i < nq; ++i) {
        q[i] = lanes::select(moves, middle[i] + half * after[i], q[i]);
        v[i] = lanes::select(moves, after[i], v[i]);
      }
      return;
    }
    for (int i = 0; i < nq; ++i) {
      v[i] = after[i];
      q[i] = middle[i] + half * after[i];
    }
  }

 private:
  ROTORUB_SLOW void forget_impacts() {
    for (ImpactList& list : impacts) list.count = 0;
    impacted_ = false;
  }

  // A middle well outside the ring (a flight of more than the clearance within half a step) goes back
  // to the circle, by the least change in the norm of A. Left to lasting contact, the depth would come
  // back as speed.
  ROTORUB_INLINE void back_to_circle() {
    const Centre d = equations::relative(*this->m_, middle_.data());
    const T square = d.x * d.x + d.y * d.y, c = this->contact.clearance;
    const Mask outside = square > c * c * lanes::all<T>(1.02);
    if (!lanes::any(outside)) return;
    if (this->coupled_) this->respond();
    const T one = lanes::all<T>(1.0);
    const T delta = lanes::select(outside, lanes::square_root(square), one);
    const T ex = d.x / delta, ey = d.y / delta;
    const auto& a = this->admittance_.a;
    const T nn = ex * (a[0][0] * ex + a[0][1] * ey) + ey * (a[1][0] * ex + a[1][1] * ey);
    this->push(middle_.data(), ex, ey, (delta - c) / nn, T{}, outside);
  }

  // The contact over the step, where its path from this middle to the next would leave the circle.
  ROTORUB_INLINE void touch(std::int64_t k) {
    const T zero{}, one = lanes::all<T>(1.0), h = lanes::all<T>(this->h_);
    const T c = this->contact.clearance;
    const Centre d = equations::relative(*this->m_, middle_.data());
    const Centre w = equations::relative(*this->m_, this->free_.data());
    const T px = d.x + h * w.x, py = d.y + h * w.y;
    const T outside = lanes::select(px * px + py * py > c * c, one, zero);
    const T lasted = this->in_contact;
    this->in_contact = outside * lasted;
    this->slip_sign = this->in_contact * this->slip_sign;
    if (!lanes::any(outside > zero)) return;

    const Mask rests = (outside > zero) & (lasted > zero);
    if (lanes::any(rests)) this->lasting_contact(rests, middle_.data(), d);
    const Mask fresh = (outside > zero) & (lasted == zero);
    if (!lanes::any(fresh)) return;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (lanes::get(fresh, lane)) collide(lane, k);
    }
  }

  // The normal at the middle; where the step is so long that it does not close along that one, the
  // normal where the path meets the circle.
  Eigen::Vector2d normal(const Eigen::Vector2d& d, const Eigen::Vector2d& w, double clearance) const {
    if (d.norm() > kNoNormal && (d.dot(w) > 0.0 || d.norm() >= clearance)) return d.normalized();
    const Eigen::Vector2d path = this->h_ * w;
    return (d + std::min(1.0, circle_exit(d, path, clearance)) * path).normalized();
  }

  // Poisson's law in one lane where the contact closes. A rebound that loads and the ring's curvature
  // undo within the step, -gddot_N h = e_r . (ddot+ - ddot) + h v_t^2 / delta, has restitution 0: the
  // middle closes the gap, by the least change in the norm of M, and contact lasts.
  ROTORUB_SLOW void collide(int lane, std::int64_t k) {
    const Model& m = lane_model(*this->m_, lane);
    const ContactParameters& c = *m.contact;
    double q[kMaxCoordinates], change[kMaxCoordinates];
    this->read_lane(middle_.data(), lane, q);
    const Eigen::Vector2d d = rotor_point(m, q) - stator_point(m, q);
    const Eigen::Vector3d free = this->lane_rates(this->free_.data(), lane);
    const Eigen::Vector3d start = this->lane_rates(this->start_.data(), lane);
    const Eigen::Vector2d e_r = normal(d, free.head<2>(), c.clearance);
    const double turn = e_r.x() * free.y() - e_r.y() * free.x();
    const double gained = e_r.dot((free - start).head<2>()) + this->h_ * turn * turn / c.clearance;
    const bool stays = c.restitution * e_r.dot(free.head<2>()) <= gained;
    const double closing = e_r.dot(free.head<2>());
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
    ImpactLaw law{c.friction, c.restitution, c.tangential_restitution};
    if (stays) law.restitution = law.tangential_restitution = 0.0;
    const ImpactResult r = solve_impact(g, -closing, slip, law);
    if (r.status != ImpactStatus::kOk) {
      return this->fail(lane, r.status == ImpactStatus::kNoSolution ? Status::kNoSolution
                                                                    : Status::kAmbiguous);
    }
    std::fill_n(change, m.nq(), 0.0);
    add_contact_load(m, contact_load(e_r, c.radius, r.normal(), r.friction()), change);
    solve_mass(m, t, q, change, change);
    for (int i = 0; i < m.nq(); ++i) {
      T& to = this->after_[static_cast<std::size_t>(i)];
      lanes::set(to, lane, lanes::get(to, lane) + change[i]);
    }
    lanes::set(this->normal_impulse, lane, r.normal());
    lanes::set(this->friction_impulse, lane, r.friction());
    note(lane, k, d, free, {0.0, r.normal(), r.friction(), -closing, r.gap_rate, slip, r.slip, 0.0});
  }

  void note(int lane, std::int64_t k, const Eigen::Vector2d& d, const Eigen::Vector3d& free,
            Impact impact) {
    const double clearance = lane_model(*this->m_, lane).contact->clearance;
    const double share = std::min(0.5, circle_exit(d, this->h_ * free.head<2>(), clearance));
    impact.t = this->origin + (static_cast<double>(k) + 0.5 + share) * this->h_;
    impact.energy_change =
        0.5 * (impact.normal_impulse * (impact.gap_rate_before + impact.gap_rate_after) +
               impact.friction_impulse * (impact.slip_before + impact.slip_after));
    impacts[lane].add(impact);
    impacted_ = true;
  }

  lanes::Array<T> middle_;
  bool impacted_ = false;
};

}  // namespace rotorub
