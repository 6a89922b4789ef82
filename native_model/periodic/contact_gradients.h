// Gradients of the gap, the gap rate and the slip of a contact with respect to the state y = (q,
// v), from (5)-(8) in contact/kinematics.h. With J of the contact, (d', spin) = J v:
//
//   dg_N = -e_r . dd
//   dgdot_N = -e_r . ddv - (e_t . d') / delta (e_t . dd)
//   dgdot_T = e_t . ddv + r dspin + gdot_N / delta (e_t . dd)
#pragma once

#include <Eigen/Core>
#include <vector>

#include "native_model/contact/kinematics.h"
#include "native_model/model/constraint.h"
#include "native_model/model/model.h"

namespace rotorub::periodic {

class ContactGradients {
 public:
  // y: 2 nq values, with a normal at the contact. The model must outlive this object.
  ContactGradients(const Model& model, const std::vector<double>& y, std::size_t contact);

  // 2 nq values each: of g_N, gdot_N and gdot_T.
  Eigen::VectorXd gap() const;
  Eigen::VectorXd gap_rate() const;
  Eigen::VectorXd slip() const;
  const ContactPoint& point() const { return point_; }

 private:
  Eigen::VectorXd row(const Eigen::Vector3d& of_q, const Eigen::Vector3d& of_v) const;

  const Model* model_;
  std::size_t contact_;
  ContactPoint point_;
};

// The gradients of everything that lasting contacts keep at 0, one row each, 2 nq columns: g_N, and
// gdot_N (kTangential) or gdot_N and gdot_T (kZero).
Eigen::MatrixXd constraint_gradients(const Model& model, const std::vector<double>& y,
                                     const ContactList<Constraint::Closed>& closed);

}  // namespace rotorub::periodic
