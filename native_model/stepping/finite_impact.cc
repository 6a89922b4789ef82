#include "native_model/stepping/finite_impact.h"

#include <algorithm>
#include <span>

#include "native_model/contact/impact_map.h"
#include "native_model/contact/impact_phase.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/system/actuation.h"

namespace rotorub {

FiniteImpact::FiniteImpact(const Model& model) : model_(&model), constraint_(model) {
  const auto n = static_cast<std::size_t>(model.nq());
  for (auto* x : {&q_, &v_, &after_compression_, &after_, &end_q_, &end_v_, &end_a_, &force_,
                  &acceleration_, &room_}) {
    x->assign(n, 0.0);
  }
}

double FiniteImpact::power(double t, const double* q, const double* v,
                           const Eigen::Vector2d& command) const {
  return external_power(*model_, t, q, v, actuator_state(*model_, q, v, command).force);
}

Eigen::Vector2d FiniteImpact::rates(const double* v, const Eigen::Vector2d& e_r) const {
  const Eigen::Vector2d w = rotor_point(*model_, v) - stator_point(*model_, v);
  return rates_along(e_r, model_->contact->radius, {w.x(), w.y(), contact_spin(*model_, v)});
}

// contact/impact_phase.h
void FiniteImpact::add_phase(double t, const double* q, double tau, double normal, double friction,
                             const Eigen::Vector2d& e_r, const std::vector<double>& from,
                             std::vector<double>& to) {
  const Model& m = *model_;
  load_phase(tau, acceleration_, from, to);
  add_load_work(tau, std::span(force_).first(static_cast<std::size_t>(m.layout.mechanical())), from.data(), to.data(),
                external_work_);
  const Eigen::Vector2d before = rates(to.data(), e_r);
  constraint_.apply(t, q, to.data(), e_r, normal, friction);
  const Eigen::Vector2d after = rates(to.data(), e_r);
  record_.normal_impulse += normal;
  record_.friction_impulse += friction;
  record_.energy_change += impulse_work(normal, friction, before, after).total();
}

Status FiniteImpact::begin(double t, const double* q, const double* v,
                                 const Eigen::Vector2d& command, bool follows) {
  const Model& m = *model_;
  const ContactParameters& c = *m.contact;
  std::copy_n(q, q_.size(), q_.begin());
  std::copy_n(v, v_.size(), v_.begin());
  touch_ = t;
  const ContactPoint touch = contact_point(m, q, v);
  smooth_force(m, t, q, v, command, force_.data());
  solve_mass(m, t, q, force_.data(), acceleration_.data());

  ImpactInput in;
  in.admittance = contact_admittance(m, t, q);
  in.e_r = touch.e_r;
  in.radius = c.radius;
  in.delta = c.clearance;
  in.velocity = {touch.dv.x(), touch.dv.y(), touch.spin};
  in.acceleration = contact_acceleration(m, acceleration_.data());
  in.compression_time = c.compression_time;
  in.expansion_time = c.expansion_time;
  const double restitution =
      restitution_beside_loads(c.restitution, -touch.gap_rate, pressing(touch, in.acceleration),
                               c.compression_time, c.expansion_time);
  const ImpactResult r = solve_impact(in, {c.friction, restitution, c.tangential_restitution});
  if (r.status != Status::kOk) return r.status;

  record_ = {};
  record_.t = t;
  record_.gap_rate_before = touch.gap_rate;
  record_.slip_before = touch.slip;
  power_at_touch_ = power(t, q, v, command);
  external_work_ = 0.0;
  middle_ = t + c.compression_time;
  end_ = middle_ + c.expansion_time;
  add_phase(t, q_.data(), c.compression_time, r.normal_compression, r.friction_compression,
            touch.e_r, v_, after_compression_);
  coordinates(middle_, room_.data());
  add_phase(middle_, room_.data(), c.expansion_time, r.normal_expansion, r.friction_expansion,
            touch.e_r, after_compression_, after_);
  const auto force = [](double impulse, double tau) { return tau > 0.0 ? impulse / tau : 0.0; };
  phase_force_[0] = force(r.normal_compression, c.compression_time);
  phase_force_[1] = force(r.friction_compression, c.compression_time);
  phase_force_[2] = force(r.normal_expansion, c.expansion_time);
  phase_force_[3] = force(r.friction_expansion, c.expansion_time);

  // What the stored energy grows by along the path, at the velocities of the phases' ends.
  external_work_ += energy(m, middle_, room_.data(), after_compression_.data()) -
                    energy(m, t, q_.data(), after_compression_.data());
  coordinates(end_, end_q_.data());
  external_work_ += energy(m, end_, end_q_.data(), after_.data()) -
                    energy(m, middle_, room_.data(), after_.data());

  end_v_ = after_;
  const ContactPoint left = contact_point(m, end_q_.data(), end_v_.data());
  record_.gap_rate_after = left.gap_rate;
  record_.slip_after = left.slip;
  closes_ = 0.0;
  if (left.gap <= 0.0) {
    // The straight path has left the circle: the way back to it is no work of the contact.
    const bool parts = left.gap_rate > 0.0;
    const double stored = energy(m, end_, end_q_.data(), end_v_.data());
    constraint_.project(end_, end_q_.data(), end_v_.data(),
                        parts ? Constraint::Velocity::kKept : Constraint::Velocity::kAlong);
    external_work_ += energy(m, end_, end_q_.data(), end_v_.data()) - stored;
    closes_ = parts ? 0.0 : 1.0;
  }
  const Eigen::Vector2d told =
      follows ? control_command(m, end_, end_q_.data(), end_v_.data()) : command;
  smooth_force(m, end_, end_q_.data(), end_v_.data(), told, end_a_.data());
  solve_mass(m, end_, end_q_.data(), end_a_.data(), end_a_.data());
  power_at_end_ = power(end_, end_q_.data(), end_v_.data(), told);
  active_ = 1.0;
  return r.status;
}

void FiniteImpact::coordinates(double t, double* q) const {
  const double first = std::min(t, middle_) - touch_, second = std::max(0.0, t - middle_);
  for (std::size_t i = 0; i < q_.size(); ++i) {
    q[i] = q_[i] + first * after_compression_[i] + second * after_[i];
  }
}

void FiniteImpact::velocities(double t, double* v) const {
  const bool first = t < middle_;
  const std::vector<double>&from = first ? v_ : after_compression_,
        &to = first ? after_compression_ : after_;
  const double tau = first ? middle_ - touch_ : end_ - middle_;
  const double share = tau > 0.0 ? std::min(1.0, (t - (first ? touch_ : middle_)) / tau) : 1.0;
  for (std::size_t i = 0; i < from.size(); ++i) v[i] = from[i] + share * (to[i] - from[i]);
}

Eigen::Vector2d FiniteImpact::force(double t) const {
  if (t <= touch_ || t >= end_) return {0.0, 0.0};
  return t < middle_ ? Eigen::Vector2d(phase_force_[0], phase_force_[1])
                     : Eigen::Vector2d(phase_force_[2], phase_force_[3]);
}

bool FiniteImpact::finish(const double*& q, const double*& v, const double*& a) {
  active_ = 0.0;
  q = end_q_.data();
  v = end_v_.data();
  a = end_a_.data();
  return closes_ > 0.0;
}

}  // namespace rotorub
