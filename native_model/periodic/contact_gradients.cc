#include "native_model/periodic/contact_gradients.h"

#include "native_model/model/dynamics.h"

namespace rotorub::periodic {

ContactGradients::ContactGradients(const Model& model, const std::vector<double>& y,
                                   std::size_t contact)
    : model_(&model),
      contact_(contact),
      point_(contact_point(model, y.data(), y.data() + model.nq(), contact)) {}

// J^T of_q for the coordinates and J^T of_v for the velocities.
Eigen::VectorXd ContactGradients::row(const Eigen::Vector3d& of_q,
                                      const Eigen::Vector3d& of_v) const {
  const int n = model_->nq();
  Eigen::VectorXd both = Eigen::VectorXd::Zero(2 * n);
  add_contact_load(*model_, of_q, both.data(), contact_);
  add_contact_load(*model_, of_v, both.data() + n, contact_);
  return both;
}

Eigen::VectorXd ContactGradients::gap() const {
  return row({-point_.e_r.x(), -point_.e_r.y(), 0.0}, Eigen::Vector3d::Zero());
}

Eigen::VectorXd ContactGradients::gap_rate() const {
  const Eigen::Vector2d turning = -point_.whirl_speed() / point_.delta * point_.e_t();
  return row({turning.x(), turning.y(), 0.0}, {-point_.e_r.x(), -point_.e_r.y(), 0.0});
}

Eigen::VectorXd ContactGradients::slip() const {
  const Eigen::Vector2d e_t = point_.e_t(), turning = point_.gap_rate / point_.delta * e_t;
  const double radius = model_->auxiliary[contact_].contact->radius;
  return row({turning.x(), turning.y(), 0.0}, {e_t.x(), e_t.y(), radius});
}

Eigen::MatrixXd constraint_gradients(const Model& model, const std::vector<double>& y,
                                     const ContactList<Constraint::Closed>& closed) {
  Eigen::MatrixXd rows(0, 2 * model.nq());
  const auto add = [&rows](const Eigen::VectorXd& gradient) {
    rows.conservativeResize(rows.rows() + 1, Eigen::NoChange);
    rows.bottomRows(1) = gradient.transpose();
  };
  for (const Constraint::Closed& c : closed) {
    const ContactGradients at(model, y, c.contact);
    add(at.gap());
    if (c.velocity != Constraint::Velocity::kAny) add(at.gap_rate());
    if (c.velocity == Constraint::Velocity::kZero) add(at.slip());
  }
  return rows;
}

}  // namespace rotorub::periodic
