#include "native_model/event/smooth_system.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"

namespace rotorub {

namespace eq = equations;

SmoothSystem::SmoothSystem(const Model& model)
    : model_(&model),
      at_(model.auxiliary.size()),
      commands_(model.auxiliary.size(), Eigen::Vector2d(0.0, 0.0)),
      inverse_mass_(model),
      f_(Eigen::VectorXd::Zero(model.nq())),
      a_(Eigen::VectorXd::Zero(model.nq())) {
  for (std::size_t k = 0; k < at_.size(); ++k) {
    const AuxiliaryBearing& bearing = model.auxiliary[k];
    at_[k].admittance = inverse_mass_.uncoupled_admittance(k, k);
    is_actuated_ = is_actuated_ || (bearing.moves() && (bearing.commanded() || bearing.magnets));
  }
}

ContactList<Constraint::Closed> SmoothSystem::rigid_contacts() const {
  ContactList<Constraint::Closed> all;
  for (std::size_t k = 0; k < at_.size(); ++k) {
    if (!in_contact(k) || model_->auxiliary[k].is_compliant()) continue;
    all.push_back({k, velocity_of(state(k).mode)});
  }
  return all;
}

Eigen::Vector2d SmoothSystem::command(std::size_t k, double t, const double* y) const {
  const AuxiliaryBearing& bearing = model_->auxiliary[k];
  if (bearing.control_state != kAbsent) {
    const double* held = y + model_->nq() + bearing.control_state;
    return {held[0], held[1]};
  }
  // The command of a record is held too.
  if (!bearing.controller || bearing.sample_time > 0.0) return at_[k].held_command;
  return control_command(*model_, t, y, y + model_->nq(), k);
}

void SmoothSystem::accelerate(double t, const double* y) {
  const Model& m = *model_;
  const double *q = y, *v = y + m.nq();
  double* f = f_.data();
  if (!m.unbalances.empty()) {
    angles_.fill(m, t, q);
    inverse_mass_.couple(angles_);
  }
  unactuated_force(m, t, angles_, q, v, f);
  if (is_actuated_) {
    for (std::size_t k = 0; k < at_.size(); ++k) commands_[k] = command(k, t, y);
    add_actuators(m, q, v, commands_, f);
  }
  inverse_mass_.solve(f, a_.data());
}

// (gddot_N, gddot_T) of a contact without any contact force, from the accelerations a_ by the
// loads.
Eigen::Vector2d SmoothSystem::free_acceleration(const ClosedContact& c) const {
  const ContactPoint& p = c.point;
  const Eigen::Vector3d dd = contact_acceleration(*model_, a_.data(), c.index);
  const double whirl = p.whirl_speed(), radius = model_->auxiliary[c.index].contact->radius;
  return {-p.e_r.dot(dd.head<2>()) - whirl * whirl / p.delta,
          p.e_t().dot(dd.head<2>()) + radius * dd.z() + whirl / p.delta * p.gap_rate};
}

// The size of the terms that add up to the normal acceleration. With several contacts, one may
// stand still while the shaft moves: the motion that cancels there counts too.
double SmoothSystem::scale_of(const ContactPoint& point, double normal, const double* q,
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

SmoothSystem::Accelerations SmoothSystem::accelerations(double t, const double* y,
                                                        std::span<ClosedContact> closed) {
  const double *q = y, *v = y + model_->nq();
  accelerate(t, y);
  for (ClosedContact& c : closed) c.point = contact_point(*model_, q, v, c.index);
  const auto n = static_cast<Eigen::Index>(closed.size());
  Accelerations all{delassus(*model_, t, q, closed), ContactVector(2 * n), ContactVector(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const ClosedContact& c = closed[static_cast<std::size_t>(i)];
    all.b.segment<2>(2 * i) = free_acceleration(c);
    all.scale[i] = scale_of(c.point, all.b[2 * i], q, v);
  }
  return all;
}

std::optional<double> SmoothSystem::compliant_force(const ClosedContact& at) const {
  const ContactParameters& c = *model_->auxiliary[at.index].contact;
  if (!c.is_compliant()) return {};
  return c.compliance.force(-at.point.gap, -at.point.gap_rate, state(at.index).hunt_crossley);
}

void SmoothSystem::set_margins(const ClosedContact& c, double normal, double friction) {
  AtContact& at = at_[c.index];
  const ContactParameters& contact = *model_->auxiliary[c.index].contact;
  at.multipliers = {normal, friction};
  const bool slides = at.state.mode == ContactMode::kSlide;
  at.margins = {normal, slides ? at.state.slip_sign * c.point.slip
                               : contact.friction.sticking() * normal - std::abs(friction)};
  // Without friction the direction of sliding does not matter.
  if (contact.friction.is_frictionless() && (slides || contact.is_compliant()))
    at.margins.tangential = kInfinity;
  if (!contact.is_compliant()) return;
  at.margins.force = contact.compliance.margin(-c.point.gap, -c.point.gap_rate,
                                               at.state.hunt_crossley, contact.clearance);
}

void SmoothSystem::set_margins_in_wall(std::size_t k, const double* q, const double* v) {
  const ContactParameters& contact = *model_->auxiliary[k].contact;
  const ContactPoint p = contact_point(*model_, q, v, k);
  const double a = at_[k].state.hunt_crossley, scale = contact.clearance;
  at_[k].margins = {contact.compliance.margin(-p.gap, 0.0, 0.0, scale),
                    -contact.compliance.margin(-p.gap, -p.gap_rate, a, scale)};
}

// mu sign(gdot_T) of a sliding contact.
double SmoothSystem::mu_sign(const ClosedContact& c) const {
  const double sign = at_[c.index].state.slip_sign;
  return model_->auxiliary[c.index].contact->friction.along(sign * c.point.slip) * sign;
}

// The force of one closed contact: its gap acceleration is 0 (or its normal force is known), and so
// is its slip acceleration if it sticks. coupling: InverseMass::coupling_at(c.index).
PlanarImpulse SmoothSystem::force_of_one(const ClosedContact& c,
                                         const Eigen::Vector3d& coupling) const {
  const AtContact& at = at_[c.index];
  const double radius = model_->auxiliary[c.index].contact->radius;
  const Delassus g =
      delassus(inverse_mass_.admittance(at.admittance, coupling), c.point.e_r, radius);
  const Eigen::Vector2d b = free_acceleration(c);
  const std::optional<double> known = compliant_force(c);
  if (at.state.mode != ContactMode::kStick) {
    const double friction = mu_sign(c), normal = known ? *known : sliding_normal(g, b[0], friction);
    return {normal, -friction * normal};
  }
  if (known) return {*known, -(b[1] + g.tn * *known) / g.tt};
  return sticking_impulse(g, b[0], b[1]);
}

// The same for several, from one linear system.
void SmoothSystem::forces_of_several(double t, const double* q, PlanarImpulse* forces) const {
  const auto rows = static_cast<Eigen::Index>(2 * closed_.size());
  ContactVector b(rows);
  CaseSystem system(rows);
  for (std::size_t i = 0; i < closed_.size(); ++i) {
    const ClosedContact& c = closed_[i];
    const auto row = static_cast<Eigen::Index>(2 * i);
    b.segment<2>(row) = free_acceleration(c);
    const std::optional<double> known = compliant_force(c);
    if (known) {
      system.given[row] = *known;
    } else {
      system.set_unknown(row);
    }
    if (at_[c.index].state.mode == ContactMode::kStick) {
      system.set_unknown(row + 1);
    } else if (known) {
      system.given[row + 1] = -mu_sign(c) * *known;
    } else {
      system.tie(row + 1, -mu_sign(c));
    }
  }
  const ContactVector force = system.solve(delassus(*model_, t, q, closed_), b);
  for (std::size_t i = 0; i < closed_.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    forces[i] = {force[row], force[row + 1]};
  }
}

// Finds the forces of the closed contacts and their margins, and adds what the forces do to the
// accelerations a.
void SmoothSystem::add_contact_forces(double t, const double* q, double* a) {
  std::array<PlanarImpulse, kMaxContacts> forces;  // not initialised: this is the hot loop
  std::array<Eigen::Vector3d, kMaxContacts> couplings;
  for (std::size_t i = 0; i < closed_.size(); ++i)
    couplings[i] = inverse_mass_.coupling_at(closed_[i].index);
  if (closed_.size() == 1) {
    forces[0] = force_of_one(closed_[0], couplings[0]);
  } else if (closed_.size() > 1) {
    forces_of_several(t, q, forces.data());
  }
  for (std::size_t i = 0; i < closed_.size(); ++i) {
    const ClosedContact& c = closed_[i];
    const auto [normal, friction] = forces[i];
    set_margins(c, normal, friction);
    const double radius = model_->auxiliary[c.index].contact->radius;
    inverse_mass_.add_response(c.index, couplings[i],
                               contact_load(c.point.e_r, radius, normal, friction), a);
  }
}

// Fills closed_. Open contacts have no multipliers and infinite margins.
void SmoothSystem::find_closed(const double* q, const double* v) {
  closed_.clear();
  for (std::size_t k = 0; k < at_.size(); ++k) {
    at_[k].multipliers = {};
    at_[k].margins = {kInfinity, kInfinity};
    if (in_contact(k)) closed_.push_back({k, contact_point(*model_, q, v, k)});
    if (state(k).in_wall) set_margins_in_wall(k, q, v);
  }
}

// Adds a closed contact's part to the rates of the integrals.
void SmoothSystem::integrate(const ClosedContact& c, double* integrals) const {
  const Model& m = *model_;
  const auto [normal, friction] = at_[c.index].multipliers;
  const double prescribed = m.auxiliary[c.index].contact->radius * m.prescribed_spin();
  integrals[integral_index(kNormalImpulse, c.index)] = normal;
  integrals[integral_index(kFrictionImpulse, c.index)] = friction;
  integrals[integral_index(kFrictionWork, c.index)] = friction * c.point.slip;
  double& work = integrals[integral_index(kContactWork, c.index)];
  work = friction * (c.point.slip - prescribed);
  if (m.auxiliary[c.index].is_compliant()) work += normal * c.point.gap_rate;
}

void SmoothSystem::derivative(double t, const double* y, double* dy) {
  const Model& m = *model_;
  const int n = m.nq();
  const double *q = y, *v = y + n;
  accelerate(t, y);
  double *a = dy + n, *integrals = dy + 2 * n;
  std::copy_n(v, n, dy);
  std::copy_n(a_.data(), n, a);

  std::fill_n(integrals, integral_count(m), 0.0);
  const double *f = f_.data(), *stiffness = m.stiffness.data();
  const double power =
      sum(m.layout.mechanical(), [=](int i) { return (f[i] + stiffness[i] * q[i]) * v[i]; });
  integrals[kExternalWork] = power + extra_power(m, angles_, q, v);

  find_closed(q, v);
  add_contact_forces(t, q, a);
  for (const ClosedContact& c : closed_) integrate(c, integrals);
  for (std::size_t k = 0; touched_ && k < m.auxiliary.size(); ++k) {
    const AuxiliaryBearing& bearing = m.auxiliary[k];
    if (!bearing.contact || (in_contact(k) && !bearing.is_compliant())) continue;
    const eq::Pair d = eq::separation(m, bearing, q), rate = eq::relative(m, bearing, v);
    const double square = d.x * d.x + d.y * d.y, along = d.x * rate.x + d.y * rate.y;
    if (square > kNoNormal * kNoNormal) integrals[kGapRateSquare] += along * along / square;
  }
}

}  // namespace rotorub
