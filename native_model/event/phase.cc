#include "native_model/event/phase.h"

#include <cmath>

#include "native_model/system/actuation.h"
#include "native_model/dynamics/dynamics.h"

namespace rotorub {
Phase::Phase(const Model& model)
    : model_(&model),
      first_touch_(kInfinity),
      margins_{kInfinity, kInfinity},
      f_(Eigen::VectorXd::Zero(model.nq())),
      a_(Eigen::VectorXd::Zero(model.nq())) {}

Eigen::Vector2d Phase::command(double t, const double* y) const {
  const Model& m = *model_;
  if (!m.controller || m.sample_time > 0.0) return held_;  // recorded ones too
  return control_command(m, t, y, y + m.nq());
}

void Phase::accelerate(double t, const double* q, const double* v, const Eigen::Vector2d& u) {
  smooth_force(*model_, t, q, v, u, f_.data());
  solve_mass(*model_, t, q, f_.data(), a_.data());
}

Phase::Contact Phase::contact_of(double t, const double* q, const double* v) const {
  const Model& m = *model_;
  Contact c;
  c.point = contact_point(m, q, v);
  const Eigen::Vector3d dd = contact_acceleration(m, a_.data());
  const double whirl = c.point.whirl_speed();
  c.b.normal = -c.point.e_r.dot(dd.head<2>()) - whirl * whirl / c.point.delta;
  c.b.tangential = c.point.e_t().dot(dd.head<2>()) + m.contact->radius * dd.z() +
                   whirl / c.point.delta * c.point.gap_rate;
  c.b.g = delassus(contact_admittance(m, t, q), c.point.e_r, m.contact->radius);
  return c;
}

Phase::Contact Phase::contact(double t, const double* y) {
  const double *q = y, *v = y + model_->nq();
  accelerate(t, q, v, command(t, y));
  Contact c = contact_of(t, q, v);
  const double whirl = c.point.whirl_speed();
  c.b.scale = whirl * whirl / c.point.delta + std::abs(c.b.normal);
  for (int i = 0; i < model_->layout.mechanical(); ++i) {
    if (model_->layout.turns(i)) continue;
    c.b.scale += std::abs(model_->stiffness[i] * q[i] / model_->mass[i]);
  }
  return c;
}

void Phase::derivative(double t, const double* y, double* dy) {
  const Model& m = *model_;
  const int n = m.nq();
  const double *q = y, *v = y + n;
  const Eigen::Vector2d u = command(t, y);
  accelerate(t, q, v, u);

  double* integrals = dy + 2 * n;
  double power = 0.0;
  for (int i = 0; i < m.layout.mechanical(); ++i) power += (f_[i] + m.stiffness[i] * q[i]) * v[i];
  integrals[kExternalWork] = power + extra_power(m, t, q, v);
  for (int k = 0; k < kExternalWork; ++k) integrals[k] = 0.0;
  integrals[kGapRateSquare] = 0.0;

  multipliers_ = {};
  margins_ = {kInfinity, kInfinity};
  if (in_contact()) {
    const Contact c = contact_of(t, q, v);
    const double mu = m.contact->friction, slip = c.point.slip;
    double normal = 0.0, friction = 0.0;
    if (state_.mode == Mode::kSlide) {
      normal = slide(c.b.g, c.b.normal, mu * state_.slip_sign);
      friction = -mu * state_.slip_sign * normal;
      margins_ = {normal, state_.slip_sign * slip};
    } else {
      const PlanarImpulse<double> force = stick(c.b.g, c.b.normal, c.b.tangential);
      normal = force.normal;
      friction = force.friction;
      margins_ = {normal, mu * normal - std::abs(friction)};
    }
    multipliers_ = {normal, friction};
    f_.setZero();
    add_contact_load(m, contact_load(c.point.e_r, m.contact->radius, normal, friction), f_.data());
    solve_mass(m, t, q, f_.data(), f_.data());
    a_ += f_;
    const double held = m.layout.spin ? 0.0 : m.contact->radius * m.speed;
    integrals[kNormalImpulse] = normal;
    integrals[kFrictionImpulse] = friction;
    integrals[kFrictionWork] = friction * slip;
    integrals[kContactWork] = friction * (slip - held);
  } else if (m.contact && std::isfinite(first_touch_)) {
    const double rate = contact_point(m, q, v).gap_rate;
    integrals[kGapRateSquare] = rate * rate;
  }
  for (int i = 0; i < n; ++i) {
    dy[i] = v[i];
    dy[n + i] = a_[i];
  }
}

}  // namespace rotorub
