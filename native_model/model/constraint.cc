#include "native_model/model/constraint.h"

#include "native_model/model/dynamics.h"

namespace rotorub {

ContactMatrix delassus(const Model& m, double t, const double* q,
                       std::span<const ClosedContact> closed) {
  const auto n = static_cast<Eigen::Index>(closed.size());
  // W_N and W_T in contact space, as in kinematics.h.
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 2 * kMaxContacts> w(3, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ClosedContact& c = closed[static_cast<std::size_t>(i)];
    const Eigen::Vector2d &e = c.point.e_r, e_t = c.point.e_t();
    w.col(2 * i) << -e.x(), -e.y(), 0.0;
    w.col(2 * i + 1) << e_t.x(), e_t.y(), m.auxiliary[c.index].contact->radius;
  }
  ContactMatrix g(2 * n, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      const Eigen::Matrix3d a =
          contact_admittance(m, m.mass.data(), t, q, closed[static_cast<std::size_t>(i)].index,
                             closed[static_cast<std::size_t>(j)].index);
      const Eigen::Matrix2d block = w.middleCols<2>(2 * i).transpose() * a * w.middleCols<2>(2 * j);
      g.block<2, 2>(2 * i, 2 * j) = block;
      g.block<2, 2>(2 * j, 2 * i) = block.transpose();
    }
  }
  return g;
}

ContactList<ClosedContact> closed_points(const Model& m, const double* q, const double* v,
                                         std::span<const Constraint::Closed> closed) {
  ContactList<ClosedContact> found;
  for (const auto& c : closed) found.push_back({c.contact, contact_point(m, q, v, c.contact)});
  return found;
}

Constraint::Constraint(const Model& model)
    : model_(&model), change_(static_cast<std::size_t>(model.nq())) {}

// change_ = M^-1 J^T load.
void Constraint::solve(double t, const double* q, const Eigen::Vector3d& load,
                       std::size_t contact) {
  std::fill(change_.begin(), change_.end(), 0.0);
  add_contact_load(*model_, load, change_.data(), contact);
  solve_mass(*model_, t, q, change_.data(), change_.data());
}

void Constraint::apply(double t, const double* q, double* v, const Eigen::Vector2d& e_r,
                       double normal, double friction, std::size_t contact) {
  const double radius = model_->auxiliary[contact].contact->radius;
  solve(t, q, contact_load(e_r, radius, normal, friction), contact);
  for (std::size_t i = 0; i < change_.size(); ++i) v[i] += change_[i];
}

void Constraint::one_to_circle(double t, double* q, const double* v, std::size_t contact) {
  const double radius = model_->auxiliary[contact].contact->radius;
  for (int k = 0; k < 2; ++k) {  // one Newton step, and one for its remaining error
    const ContactPoint p = contact_point(*model_, q, v, contact);
    const Delassus g = delassus(contact_admittance(*model_, t, q, contact), p.e_r, radius);
    solve(t, q, contact_load(p.e_r, 0.0, -p.gap / g.nn, 0.0), contact);
    for (std::size_t i = 0; i < change_.size(); ++i) q[i] += change_[i];
  }
}

void Constraint::to_circles(double t, double* q, const double* v, std::span<const Closed> closed) {
  if (closed.size() == 1) return one_to_circle(t, q, v, closed.front().contact);
  const auto n = static_cast<Eigen::Index>(closed.size());
  for (int k = 0; k < 2 && n > 0; ++k) {
    const ContactList<ClosedContact> at = closed_points(*model_, q, v, closed);
    const ContactMatrix g = delassus(*model_, t, q, at);
    ContactMatrix normal(n, n);
    ContactVector gap(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      gap[i] = -at[static_cast<std::size_t>(i)].point.gap;
      for (Eigen::Index j = 0; j < n; ++j) normal(i, j) = g(2 * i, 2 * j);
    }
    const ContactVector p = shared_solution(normal, gap);
    for (std::size_t i = 0; i < at.size(); ++i) {
      solve(t, q, contact_load(at[i].point.e_r, 0.0, p[static_cast<Eigen::Index>(i)], 0.0),
            at[i].index);
      for (std::size_t j = 0; j < change_.size(); ++j) q[j] += change_[j];
    }
  }
}

void Constraint::project(double t, double* q, double* v, std::span<const Closed> closed) {
  ContactList<Closed> on_circles;
  for (const Closed& c : closed) {
    if (c.velocity != Velocity::kSticking) on_circles.push_back(c);
  }
  to_circles(t, q, v, {on_circles.data(), on_circles.size()});
  if (closed.size() == 1) return project_one(t, q, v, closed.front());
  project_several(t, q, v, closed);
}

void Constraint::project_one(double t, double* q, double* v, const Closed& closed) {
  if (closed.velocity == Velocity::kAny) return;
  const std::size_t k = closed.contact;
  const ContactPoint p = contact_point(*model_, q, v, k);
  const Delassus g =
      delassus(contact_admittance(*model_, t, q, k), p.e_r, model_->auxiliary[k].contact->radius);
  PlanarImpulse l{-p.gap_rate / g.nn, 0.0};
  if (closed.velocity == Velocity::kZero) l = sticking_impulse(g, p.gap_rate, p.slip);
  if (closed.velocity == Velocity::kSticking) l = {0.0, -p.slip / g.tt};
  apply(t, q, v, p.e_r, l.normal, l.friction, k);
}

// The unknowns are the impulses along the rates that must become 0.
void Constraint::project_several(double t, double* q, double* v, std::span<const Closed> closed) {
  const ContactList<ClosedContact> at = closed_points(*model_, q, v, closed);
  const auto rows = static_cast<Eigen::Index>(2 * at.size());
  CaseSystem system(rows);
  ContactVector rates(rows);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    rates.segment<2>(row) << at[i].point.gap_rate, at[i].point.slip;
    const Velocity velocity = closed[i].velocity;
    if (velocity == Velocity::kTangential || velocity == Velocity::kZero) system.set_unknown(row);
    if (velocity == Velocity::kZero || velocity == Velocity::kSticking) system.set_unknown(row + 1);
  }
  if (system.count == 0) return;
  const ContactVector p = system.solve(delassus(*model_, t, q, at), rates);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    apply(t, q, v, at[i].point.e_r, p[row], p[row + 1], at[i].index);
  }
}

}  // namespace rotorub
