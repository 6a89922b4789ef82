#include "native_model/event/phase.h"

#include <algorithm>
#include <cmath>

#include "native_model/dynamics/dynamics.h"
#include "native_model/system/actuation.h"

namespace rotorub {

Phase::Phase(const Model& model)
    : model_(&model),
      at_(model.auxiliary.size()),
      commands_(model.auxiliary.size(), Eigen::Vector2d(0.0, 0.0)),
      f_(Eigen::VectorXd::Zero(model.nq())),
      a_(Eigen::VectorXd::Zero(model.nq())) {}

Eigen::Vector2d Phase::command(std::size_t k, double t, const double* y) const {
  const AuxiliaryBearing& bearing = model_->auxiliary[k];
  if (!bearing.controller || bearing.sample_time > 0.0) return at_[k].held;  // recorded ones too
  return control_command(*model_, t, y, y + model_->nq(), k);
}

void Phase::accelerate(double t, const double* y) {
  const double *q = y, *v = y + model_->nq();
  for (std::size_t k = 0; k < at_.size(); ++k) commands_[k] = command(k, t, y);
  smooth_force(*model_, t, q, v, commands_, f_.data());
  solve_mass(*model_, t, q, f_.data(), a_.data());
}

// By the accelerations a_ of all other loads, without scales.
Phase::Accelerations Phase::unloaded(double t, const double* y,
                                     std::span<ClosedContact> closed) const {
  const Model& m = *model_;
  const double *q = y, *v = y + m.nq();
  const auto n = static_cast<Eigen::Index>(closed.size());
  Accelerations all{{}, ContactVector(2 * n), {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    ClosedContact& c = closed[static_cast<std::size_t>(i)];
    const ContactPoint& p = c.point = contact_point(m, q, v, c.index);
    const Eigen::Vector3d dd = contact_acceleration(m, a_.data(), c.index);
    const double whirl = p.whirl_speed(), radius = m.auxiliary[c.index].contact->radius;
    all.b[2 * i] = -p.e_r.dot(dd.head<2>()) - whirl * whirl / p.delta;
    all.b[2 * i + 1] = p.e_t().dot(dd.head<2>()) + radius * dd.z() + whirl / p.delta * p.gap_rate;
    if (n > 1) continue;
    const Delassus g = delassus(contact_admittance(m, t, q, c.index), p.e_r, radius);
    all.g = Eigen::Matrix2d{{g.nn, g.nt}, {g.tn, g.tt}};
  }
  if (n > 1) all.g = delassus(m, t, q, closed);
  return all;
}

// What adds up to the normal acceleration. Of one of several contacts that stands still while the
// shaft moves, the motion that cancels there too.
double Phase::scale_of(const ContactPoint& point, double normal, const double* q,
                       const double* v) const {
  const double whirl = point.whirl_speed();
  double scale = whirl * whirl / point.delta + std::abs(normal);
  for (int i = 0; i < model_->layout.mechanical(); ++i) {
    if (model_->layout.turns(i)) continue;
    scale += std::abs(model_->stiffness[i] * q[i] / model_->mass[i]);
    if (at_.size() > 1) scale += v[i] * v[i] / point.delta;
  }
  return scale;
}

Phase::Accelerations Phase::accelerations(double t, const double* y,
                                          std::span<ClosedContact> closed) {
  accelerate(t, y);
  Accelerations all = unloaded(t, y, closed);
  all.scale.resize(static_cast<Eigen::Index>(closed.size()));
  for (Eigen::Index i = 0; i < all.scale.size(); ++i) {
    all.scale[i] =
        scale_of(closed[static_cast<std::size_t>(i)].point, all.b[2 * i], y, y + model_->nq());
  }
  return all;
}

std::optional<double> Phase::pressing(const ClosedContact& at) const {
  const ContactParameters& c = *model_->auxiliary[at.index].contact;
  if (!c.gives()) return {};
  return c.compliance.force(-at.point.gap, -at.point.gap_rate, state(at.index).hunt_crossley);
}

void Phase::set_margins(const ClosedContact& c, double normal, double friction) {
  AtContact& at = at_[c.index];
  const ContactParameters& contact = *model_->auxiliary[c.index].contact;
  at.multipliers = {normal, friction};
  at.margins = {normal, at.state.mode == Mode::kSlide
                            ? at.state.slip_sign * c.point.slip
                            : contact.friction.sticking() * normal - std::abs(friction)};
  if (!contact.gives()) return;
  at.margins.force = contact.compliance.margin(-c.point.gap, -c.point.gap_rate,
                                               at.state.hunt_crossley, contact.clearance);
  // Without friction it does not matter which way it slides.
  if (contact.friction.none()) at.margins.cone = kInfinity;
}

void Phase::set_margins_in_wall(std::size_t k, const double* q, const double* v) {
  const ContactParameters& contact = *model_->auxiliary[k].contact;
  const ContactPoint p = contact_point(*model_, q, v, k);
  const double a = at_[k].state.hunt_crossley, scale = contact.clearance;
  at_[k].margins = {contact.compliance.margin(-p.gap, 0.0, 0.0, scale),
                    -contact.compliance.margin(-p.gap, -p.gap_rate, a, scale)};
}

// Of all that are closed, which it gives. Unknown is the normal force of each, and of one that
// sticks its friction; gddot of each is 0. Multipliers and margins of the others are none.
ContactList<ClosedContact> Phase::find_multipliers(double t, const double* y) {
  ContactList<ClosedContact> closed;
  for (std::size_t k = 0; k < at_.size(); ++k) {
    at_[k].multipliers = {};
    at_[k].margins = {kInfinity, kInfinity};
    if (in_contact(k)) closed.push_back({k, {}});
    if (state(k).in_wall) set_margins_in_wall(k, y, y + model_->nq());
  }
  if (closed.empty()) return closed;
  const Accelerations all = unloaded(t, y, closed);
  // Of a sliding one, mu sign(gdot_T).
  const auto mu_sign = [this](const ClosedContact& c) {
    const double sign = at_[c.index].state.slip_sign;
    return model_->auxiliary[c.index].contact->friction.along(sign * c.point.slip) * sign;
  };
  const auto sticks = [this](const ClosedContact& c) {
    return at_[c.index].state.mode == Mode::kStick;
  };
  if (closed.size() == 1) {
    const ClosedContact& c = closed[0];
    const Delassus g{all.g(0, 0), all.g(0, 1), all.g(1, 0), all.g(1, 1)};
    PlanarImpulse<double> force{0.0, 0.0};
    const std::optional<double> known = pressing(c);
    if (!sticks(c)) {
      force.normal = known ? *known : slide(g, all.b[0], mu_sign(c));
      force.friction = -mu_sign(c) * force.normal;
    } else if (known) {
      force = {*known, -(all.b[1] + g.tn * *known) / g.tt};
    } else {
      force = stick(g, all.b[0], all.b[1]);
    }
    set_margins(c, force.normal, force.friction);
    return closed;
  }
  CaseSystem system(all.b.size());
  for (std::size_t i = 0; i < closed.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    const std::optional<double> known = pressing(closed[i]);
    if (known) {
      system.given[row] = *known;
    } else {
      system.free(row);
    }
    if (sticks(closed[i])) {
      system.free(row + 1);
    } else if (known) {
      system.given[row + 1] = -mu_sign(closed[i]) * *known;
    } else {
      system.bring(row + 1, -mu_sign(closed[i]));
    }
  }
  const ContactVector force = system.solve(all.g, all.b);
  for (std::size_t i = 0; i < closed.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    set_margins(closed[i], force[row], force[row + 1]);
  }
  return closed;
}

void Phase::derivative(double t, const double* y, double* dy) {
  const Model& m = *model_;
  const int n = m.nq();
  const double *q = y, *v = y + n;
  accelerate(t, y);

  double* integrals = dy + 2 * n;
  double power = 0.0;
  for (int i = 0; i < m.layout.mechanical(); ++i) power += (f_[i] + m.stiffness[i] * q[i]) * v[i];
  std::fill_n(integrals, integral_count(m), 0.0);
  integrals[kExternalWork] = power + extra_power(m, t, q, v);

  const ContactList<ClosedContact> closed = find_multipliers(t, y);
  if (!closed.empty()) f_.setZero();
  for (const ClosedContact& c : closed) {
    const double radius = m.auxiliary[c.index].contact->radius;
    const auto [normal, friction] = at_[c.index].multipliers;
    add_contact_load(m, contact_load(c.point.e_r, radius, normal, friction), f_.data(), c.index);
    const double held = m.layout.spin ? 0.0 : radius * m.speed;
    integrals[integral_index(kNormalImpulse, c.index)] = normal;
    integrals[integral_index(kFrictionImpulse, c.index)] = friction;
    integrals[integral_index(kFrictionWork, c.index)] = friction * c.point.slip;
    double& work = integrals[integral_index(kContactWork, c.index)];
    work = friction * (c.point.slip - held);
    if (m.auxiliary[c.index].gives()) work += normal * c.point.gap_rate;
  }
  if (!closed.empty()) {
    solve_mass(m, t, q, f_.data(), f_.data());
    a_ += f_;
  }
  if ((!in_contact(0) || m.first().gives()) && m.first().contact &&
      std::isfinite(at_[0].first_touch)) {
    const double rate = contact_point(m, q, v).gap_rate;
    integrals[kGapRateSquare] = rate * rate;
  }
  for (int i = 0; i < n; ++i) {
    dy[i] = v[i];
    dy[n + i] = a_[i];
  }
}

}  // namespace rotorub
