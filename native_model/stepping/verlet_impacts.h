// The impacts of `verlet`, lane by lane: where the straight path of a step leaves the circle, out
// of flight. Of the jump w of the velocities at the share theta of the step, this step takes (1 -
// theta) w, the next one the rest, and what the loads that depend on velocities miss of it,
// -(theta - 1/2) h M^-1 (F(v + w) - F(v)); without that term order 2 is lost. An impact that takes
// time (finite_impact.h) goes on over steps; flight is taken up again where it ends, at any share
// of a step.
#pragma once

#include <vector>

#include "native_model/contact/step_contact.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/stepping/contact_kernel.h"
#include "native_model/system/finite_impact.h"

namespace rotorub {

template <class M>
class VerletImpacts : public ContactKernel<M> {
  using Base = ContactKernel<M>;

 public:
  using typename Base::T;
  static constexpr int kLanes = Base::kLanes;

  VerletImpacts(const M& m, const std::vector<const Model*>& models, double h)
      : Base(m, models, h) {
    if (!this->contact_) return;
    for (const Model* model : models)
      takes_time_ = takes_time_ || model->first().contact->impact_time() > 0.0;
    for (const Model* model : models) {
      if (takes_time_) lasting_.emplace_back(*model);
    }
  }

  // J, of the impacts of the step: what the mean of the step's velocities misses of the loads'
  // work.
  double late_work = 0.0;
  // s, of a lane's impact of the step that takes time; 0: none began.
  double impact_time[kLanes] = {};
  // N, normal and friction force at t_k of a lane's impact that takes time.
  Eigen::Vector2d impact_force(int lane, std::int64_t k) const {
    if (!takes_time_) return {0.0, 0.0};
    return lasting_[static_cast<std::size_t>(lane)].force(this->origin +
                                                          static_cast<double>(k) * this->h_);
  }

 protected:
  // The impacts of one lane.
  ROTORUB_SLOW void collide(int lane, std::int64_t k) {
    const Model& m = lane_model(*this->m_, lane);
    const ContactParameters& c = *m.first().contact;
    const int nq = m.nq();
    const double h = this->h_, kick = was_first_ ? 0.5 * h : h;
    const double t = this->origin + static_cast<double>(k) * h;
    double q[kMaxCoordinates], start[kMaxCoordinates], v[kMaxCoordinates];
    this->read_lane(this->q_.data(), lane, q);
    this->read_lane(this->start_.data(), lane, start);
    this->read_lane(this->free_.data(), lane, v);

    FlightStep s;
    s.h = h;
    s.d = separation(m, q);
    s.velocity = this->lane_rates(this->free_.data(), lane);
    s.acceleration = (s.velocity - this->lane_rates(this->start_.data(), lane)) / kick;
    s.clearance = c.clearance;
    s.radius = c.radius;
    if (m.coupled_mass()) {  // M(phi) of the impact
      const double share = circle_exit(s.d, h * s.velocity.head<2>(), c.clearance);
      for (int i = 0; i < nq; ++i) q[i] += std::min(1.0, share) * h * v[i];
    }
    s.admittance = contact_admittance(m, t, q);
    s.duration = c.impact_time();
    const StepImpacts hits = locate_impacts(s, c.law());
    if (hits.status != Status::kOk) return this->fail(lane, hits.status);
    for (int i = 0; i < nq; ++i) start[i] = (v[i] - start[i]) / kick;  // acceleration, from here on
    const Eigen::Vector2d u{lanes::get(this->command_x, lane), lanes::get(this->command_y, lane)};
    for (int n = 0; n < hits.count; ++n) {
      const LocatedImpact& hit = hits.impacts[static_cast<std::size_t>(n)];
      if (hits.takes_time && n + 1 == hits.count)
        return begin_lasting(lane, k, v, start, hit.theta);
      apply(lane, m, t, q, v, start, u, hit);
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
    add_contact_load(m, contact_load(hit.e_r, m.first().contact->radius, normal, friction), jump);
    solve_mass(m, t, q, jump, jump);
    // The loads by the velocities just before and just after.
    for (int i = 0; i < nq; ++i) at[i] = v[i] + late * a[i];
    // A continuous controller sees the jump too.
    const bool follows =
        m.first().controller && m.first().sample_time == 0.0 && t >= m.first().control_on;
    const auto command = [&] { return follows ? control_command(m, t, q, at) : u; };
    Eigen::Vector2d told = command();
    smooth_force(m, t, q, at, told, before);
    const double power = external_power(m, t, q, at, actuator_state(m, q, at, told).force);
    for (int i = 0; i < nq; ++i) at[i] += jump[i];
    told = command();
    smooth_force(m, t, q, at, told, missed);
    late_work -= late * (external_power(m, t, q, at, actuator_state(m, q, at, told).force) - power);
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
    this->impacts[static_cast<std::size_t>(lane)].add(
        {t + theta * h, normal, friction, hit.gap_rate_before, hit.law.gap_rate, hit.slip_before,
         hit.law.slip,
         0.5 * (normal * (hit.gap_rate_before + hit.law.gap_rate) +
                friction * (hit.slip_before + hit.law.slip))});
  }

  // ------------------------------------------------------------------ impacts that take time
  // The lanes in one, before the step.
  ROTORUB_SLOW void find_lasting() {
    this->impact_lasts_ = false;
    for (int lane = 0; lane < kLanes; ++lane) {
      const bool lasts = lasting_[static_cast<std::size_t>(lane)].active();
      lanes::set(this->flying_, lane, lasts ? 0.0 : 1.0);
      this->impact_lasts_ = this->impact_lasts_ || lasts;
    }
  }
  ROTORUB_SLOW void show_lasting(int lane, std::int64_t k, T* now) const {
    double v[kMaxCoordinates];
    lasting_[static_cast<std::size_t>(lane)].velocities(
        this->origin + static_cast<double>(k) * this->h_, v);
    for (int i = 0; i < this->layout().nq(); ++i) lanes::set(now[i], lane, v[i]);
  }
  ROTORUB_SLOW void go_on_lasting(std::int64_t k) {
    last_time_ = static_cast<double>(k) * this->h_;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (lanes::get(this->flying_, lane) == 0.0) follow(lane, k);
    }
  }

  // A touch at the share theta of step k, the loads' accelerations a; v: velocities of the middle.
  ROTORUB_SLOW void begin_lasting(int lane, std::int64_t k, const double* v, const double* a,
                                  double theta) {
    const double h = this->h_, late = (theta - 0.5) * h;
    const double t = this->origin + (static_cast<double>(k) + theta) * h;
    double at[kMaxCoordinates], rates[kMaxCoordinates];
    const Model& m = lane_model(*this->m_, lane);
    for (int i = 0; i < m.nq(); ++i) {
      at[i] = lanes::get(this->q_[static_cast<std::size_t>(i)], lane) + theta * h * v[i];
      rates[i] = v[i] + late * a[i];
    }
    const bool follows =
        m.first().controller && m.first().sample_time == 0.0 && t >= m.first().control_on;
    const Eigen::Vector2d held{lanes::get(this->command_x, lane),
                               lanes::get(this->command_y, lane)};
    FiniteImpact& impact = lasting_[static_cast<std::size_t>(lane)];
    const Status found =
        impact.begin(t, at, rates, follows ? control_command(m, t, at, rates) : held, follows);
    if (found != Status::kOk) return this->fail(lane, found);
    // The kick went on to the middle of the step.
    late_work += late * impact.power_at_touch() + impact.external_work();
    impact_time[lane] = impact.end() - t;
    const Impact& record = impact.record();
    const auto add = [lane](T& to, double x) { lanes::set(to, lane, lanes::get(to, lane) + x); };
    add(this->normal_impulse, record.normal_impulse);
    add(this->friction_impulse, record.friction_impulse);
    this->impacts[static_cast<std::size_t>(lane)].add(record);
    this->impacted_ = true;
    lanes::set(this->in_contact, lane, 0.0);
    lanes::set(this->slip_sign, lane, 0.0);
    follow(lane, k);
  }

  // To the end of step k: within the impact, or in flight again.
  void follow(int lane, std::int64_t k) {
    FiniteImpact& impact = lasting_[static_cast<std::size_t>(lane)];
    const double h = this->h_, from = this->origin + static_cast<double>(k) * h, end = from + h;
    const int nq = this->layout().nq();
    double to[kMaxCoordinates];
    if (end < impact.end()) {
      impact.coordinates(end, to);
      for (int i = 0; i < nq; ++i) {
        const auto c = static_cast<std::size_t>(i);
        lanes::set(this->after_[c], lane, (to[i] - lanes::get(this->q_[c], lane)) / h);
      }
      return;
    }
    const double *q, *v, *a;
    const double left = end - impact.end(), late = left - 0.5 * h;
    late_work += late * impact.power_at_end();
    const bool closes = impact.finish(q, v, a);
    for (int i = 0; i < nq; ++i) {
      const auto c = static_cast<std::size_t>(i);
      const double after =
          (q[i] + left * (v[i] + 0.5 * left * a[i]) - lanes::get(this->q_[c], lane)) / h;
      lanes::set(this->after_[c], lane, after);
      lanes::set(late_[c], lane, v[i] + late * a[i] - after);
    }
    owes_ = 1.0;
    lanes::set(this->in_contact, lane, closes ? 1.0 : 0.0);
  }

  typename Base::Coordinates late_ =
      Base::make(*this->m_);         // m/s, rad/s: what the last step left over
  double first_ = 1.0, owes_ = 0.0;  // 1: the next step is half a kick; late_ holds something
  bool was_first_ = true;
  bool takes_time_ = false;            // an impact, of a lane at least
  std::vector<FiniteImpact> lasting_;  // of each lane, if so
  double last_time_ = 0.0;             // s, of the last step, from `origin`
};

}  // namespace rotorub
