#include "native_model/dynamics/constraint.h"

#include "native_model/contact/kinematics.h"
#include "native_model/dynamics/dynamics.h"

namespace rotorub {

Constraint::Constraint(const Model& model)
    : model_(&model), change_(static_cast<std::size_t>(model.nq())) {}

// change = M^-1 J^T load.
void Constraint::solve(double t, const double* q, const Eigen::Vector3d& load) {
  std::fill(change_.begin(), change_.end(), 0.0);
  add_contact_load(*model_, load, change_.data());
  solve_mass(*model_, t, q, change_.data(), change_.data());
}

void Constraint::apply(double t, const double* q, double* v, const Eigen::Vector2d& e_r,
                       double normal, double friction) {
  solve(t, q, contact_load(e_r, model_->contact->radius, normal, friction));
  for (std::size_t i = 0; i < change_.size(); ++i) v[i] += change_[i];
}

void Constraint::to_circle(double t, double* q, const double* v) {
  for (int k = 0; k < 2; ++k) {  // one Newton step and what round-off leaves
    const ContactPoint p = contact_point(*model_, q, v);
    const Delassus g = delassus(contact_admittance(*model_, t, q), p.e_r, model_->contact->radius);
    solve(t, q, contact_load(p.e_r, 0.0, -p.gap / g.nn, 0.0));
    for (std::size_t i = 0; i < change_.size(); ++i) q[i] += change_[i];
  }
}

void Constraint::project(double t, double* q, double* v, Velocity velocity) {
  to_circle(t, q, v);
  if (velocity == Velocity::kKept) return;
  const ContactPoint p = contact_point(*model_, q, v);
  const Delassus g = delassus(contact_admittance(*model_, t, q), p.e_r, model_->contact->radius);
  const PlanarImpulse<double> l = velocity == Velocity::kStuck
                                      ? stick(g, p.gap_rate, p.slip)
                                      : PlanarImpulse<double>{-p.gap_rate / g.nn, 0.0};
  apply(t, q, v, p.e_r, l.normal, l.friction);
}

}  // namespace rotorub
