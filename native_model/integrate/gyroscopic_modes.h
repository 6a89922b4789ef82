// The gyroscopic part of (1) on its own: M v' = -Omega [[0, g], [-g^T, 0]] v turns the velocities of
// the two planes into each other and keeps the kinetic energy. With the singular values of
// M_x^-1/2 g M_y^-1/2 = U S V^T, each pair a = U^T M_x^1/2 v_x, b = V^T M_y^1/2 v_y turns by the
// angle S_k Omega h: a' = -S Omega b, b' = +S Omega a.
#pragma once

#include <Eigen/Core>

#include "native_model/system/model.h"

namespace rotorub {

struct GyroscopicModes {
  bool diagonal = false;              // U, V = 1: each mode turns with its partner
  Eigen::VectorXd rate;               // S, n, rad of turn per rad of spin; empty: no gyroscopics
  Eigen::MatrixXd to_x, to_y;         // U^T M_x^1/2, V^T M_y^1/2, n x n
  Eigen::MatrixXd from_x, from_y;     // their inverses M_x^-1/2 U, M_y^-1/2 V
};

GyroscopicModes gyroscopic_modes(const Model& model);

}  // namespace rotorub
