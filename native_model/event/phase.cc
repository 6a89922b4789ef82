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

bool Phase::in_contact() const {
  return std::any_of(at_.begin(), at_.end(),
                     [](const AtContact& at) { return at.state.mode != Mode::kFree; });
}

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

Phase::Contact Phase::contact_of(std::size_t k, double t, const double* q, const double* v) const {
  const Model& m = *model_;
  const double radius = m.auxiliary[k].contact->radius;
  Contact c;
  c.point = contact_point(m, q, v, k);
  const Eigen::Vector3d dd = contact_acceleration(m, a_.data(), k);
  const double whirl = c.point.whirl_speed();
  c.b.normal = -c.point.e_r.dot(dd.head<2>()) - whirl * whirl / c.point.delta;
  c.b.tangential =
      c.point.e_t().dot(dd.head<2>()) + radius * dd.z() + whirl / c.point.delta * c.point.gap_rate;
  c.b.g = delassus(contact_admittance(m, t, q, k), c.point.e_r, radius);
  return c;
}

// What adds up to the normal acceleration. Of one of several contacts that stands still while the
// shaft moves, the motion that cancels there too.
double Phase::scale_of(const Contact& c, const double* q, const double* v) const {
  const double whirl = c.point.whirl_speed();
  double scale = whirl * whirl / c.point.delta + std::abs(c.b.normal);
  for (int i = 0; i < model_->layout.mechanical(); ++i) {
    if (model_->layout.turns(i)) continue;
    scale += std::abs(model_->stiffness[i] * q[i] / model_->mass[i]);
    if (at_.size() > 1) scale += v[i] * v[i] / c.point.delta;
  }
  return scale;
}

Phase::Contact Phase::contact(std::size_t k, double t, const double* y) {
  const double *q = y, *v = y + model_->nq();
  accelerate(t, y);
  Contact c = contact_of(k, t, q, v);
  c.b.scale = scale_of(c, q, v);
  return c;
}

Phase::Accelerations Phase::accelerations(double t, const double* y,
                                          std::span<ClosedContact> closed) {
  const double *q = y, *v = y + model_->nq();
  accelerate(t, y);
  const auto n = static_cast<Eigen::Index>(closed.size());
  Accelerations all{{}, ContactVector(2 * n), ContactVector(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    ClosedContact& c = closed[static_cast<std::size_t>(i)];
    const Contact found = contact_of(c.index, t, q, v);
    c.point = found.point;
    all.b.segment<2>(2 * i) << found.b.normal, found.b.tangential;
    all.scale[i] = scale_of(found, q, v);
  }
  all.g = delassus(*model_, t, q, closed);
  return all;
}

void Phase::set_margins(std::size_t k, double normal, double friction, double slip) {
  AtContact& at = at_[k];
  at.multipliers = {normal, friction};
  if (at.state.mode == Mode::kSlide) {
    at.margins = {normal, at.state.slip_sign * slip};
  } else {
    const double mu = model_->auxiliary[k].contact->friction.sticking();
    at.margins = {normal, mu * normal - std::abs(friction)};
  }
}

// The only one that is closed.
void Phase::find_multiplier(std::size_t k, double t, const double* y, ContactPoint& point) {
  const Contact c = contact_of(k, t, y, y + model_->nq());
  const ContactState& state = at_[k].state;
  PlanarImpulse<double> force{0.0, 0.0};
  if (state.mode == Mode::kSlide) {
    const double mu = model_->auxiliary[k].contact->friction.at(c.point.slip);
    force.normal = slide(c.b.g, c.b.normal, mu * state.slip_sign);
    force.friction = -mu * state.slip_sign * force.normal;
  } else {
    force = stick(c.b.g, c.b.normal, c.b.tangential);
  }
  point = c.point;
  set_margins(k, force.normal, force.friction, c.point.slip);
}

// Unknown is the normal force of each, and of one that sticks its friction; gddot of each is 0.
void Phase::find_multipliers(double t, const double* y, std::span<ClosedContact> closed) {
  const double *q = y, *v = y + model_->nq();
  const auto n = static_cast<Eigen::Index>(closed.size());
  ContactVector b(2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    ClosedContact& c = closed[static_cast<std::size_t>(i)];
    const Contact found = contact_of(c.index, t, q, v);
    c.point = found.point;
    b.segment<2>(2 * i) << found.b.normal, found.b.tangential;
  }
  const ContactMatrix g = delassus(*model_, t, q, closed);
  ContactMatrix columns = ContactMatrix::Zero(2 * n, 2 * n);
  std::array<Eigen::Index, 2 * kMaxContacts> rows{};
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t k = closed[static_cast<std::size_t>(i)].index;
    const ContactState& state = at_[k].state;
    columns(2 * i, count) = 1.0;
    if (state.mode == Mode::kSlide) {
      const double slip = closed[static_cast<std::size_t>(i)].point.slip;
      columns(2 * i + 1, count) =
          -model_->auxiliary[k].contact->friction.at(slip) * state.slip_sign;
    }
    rows[static_cast<std::size_t>(count++)] = 2 * i;
    if (state.mode != Mode::kStick) continue;
    columns(2 * i + 1, count) = 1.0;
    rows[static_cast<std::size_t>(count++)] = 2 * i + 1;
  }
  const ContactMatrix carried = g * columns.leftCols(count);
  ContactMatrix matrix(count, count);
  ContactVector right(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index row = rows[static_cast<std::size_t>(i)];
    matrix.row(i) = carried.row(row);
    right[i] = -b[row];
  }
  const ContactVector force = columns.leftCols(count) * shared_solution(matrix, right);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ClosedContact& c = closed[static_cast<std::size_t>(i)];
    set_margins(c.index, force[2 * i], force[2 * i + 1], c.point.slip);
  }
}

// The contacts that are closed stand first in closed_; multipliers and margins of the others are
// none.
std::size_t Phase::find_closed() {
  std::size_t count = 0;
  for (std::size_t k = 0; k < at_.size(); ++k) {
    at_[k].multipliers = {};
    at_[k].margins = {kInfinity, kInfinity};
    if (in_contact(k)) closed_[count++].index = k;
  }
  return count;
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

  const std::size_t count = find_closed();
  const std::span<ClosedContact> closed = std::span(closed_).first(count);
  if (count == 1) find_multiplier(closed[0].index, t, y, closed[0].point);
  if (count > 1) find_multipliers(t, y, closed);
  if (count > 0) f_.setZero();
  for (const ClosedContact& c : closed) {
    const double radius = m.auxiliary[c.index].contact->radius;
    const auto [normal, friction] = at_[c.index].multipliers;
    add_contact_load(m, contact_load(c.point.e_r, radius, normal, friction), f_.data(), c.index);
    const double held = m.layout.spin ? 0.0 : radius * m.speed;
    integrals[integral_index(kNormalImpulse, c.index)] = normal;
    integrals[integral_index(kFrictionImpulse, c.index)] = friction;
    integrals[integral_index(kFrictionWork, c.index)] = friction * c.point.slip;
    integrals[kContactWork] += friction * (c.point.slip - held);
  }
  if (count > 0) {
    solve_mass(m, t, q, f_.data(), f_.data());
    a_ += f_;
  }
  if (!in_contact(0) && m.first().contact && std::isfinite(at_[0].first_touch)) {
    const double rate = contact_point(m, q, v).gap_rate;
    integrals[kGapRateSquare] = rate * rate;
  }
  for (int i = 0; i < n; ++i) {
    dy[i] = v[i];
    dy[n + i] = a_[i];
  }
}

}  // namespace rotorub
