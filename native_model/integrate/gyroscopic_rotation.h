// The gyroscopic part of (1) on its own: M v' = -Omega [[0, g], [-g^T, 0]] v turns the velocities of
// the two planes into each other and keeps the kinetic energy. With the singular values of
// M_x^-1/2 g M_y^-1/2 = U S V^T each pair (U_k, V_k) turns by the angle S_k Omega h.
#pragma once

#include <Eigen/Core>

#include "native_model/system/model.h"

namespace rotorub {

class GyroscopicRotation {
 public:
  explicit GyroscopicRotation(const Model& model);
  bool absent() const { return rates_.size() == 0; }
  // v (nq values) over the time h at the speed omega, by the Cayley transform: a rotation for any
  // h, second order in its angle.
  void apply(double omega, double h, double* v);

 private:
  int modes_ = 0, x_ = 0, y_ = 0;
  bool diagonal_ = false;
  Eigen::VectorXd rates_;                // S, rad of turn per rad of spin
  Eigen::VectorXd scale_;                // diagonal: sqrt(m_y / m_x)
  Eigen::MatrixXd to_x_, to_y_;          // U^T M_x^1/2, V^T M_y^1/2
  Eigen::MatrixXd from_x_, from_y_;      // M_x^-1/2 U, M_y^-1/2 V
  Eigen::VectorXd a_, b_;                // pair coordinates, workspace
};

}  // namespace rotorub
