// The linear equations of bending at a constant spin speed Omega, for both planes (x_1..x_n,
// y_1..y_n):
//
//   M q'' + C q' + K q = loads
//
// Each column is computed by the list of loads (loads.h) for a unit value of one coordinate, so
// that the matrices contain exactly the loads of that list.
#pragma once

#include <Eigen/Core>

#include "native_model/model/model.h"

namespace rotorub {

struct LinearParts {
  // kg, 2 n, > 0: diagonal of M (model.h).
  Eigen::VectorXd mass;
  // N s/m, 2 n x 2 n: external modal damping D >= 0 on the diagonal; dashpots of the bearings; c of
  // the films at Omega; k_i D of the magnetic bearings' laws; rotating damping N_xx, N_yy;
  // gyroscopic terms, Omega G in the rows of x and columns of y, -Omega G^T in the rows of y and
  // columns of x.
  Eigen::MatrixXd damping;
  // N/m, 2 n x 2 n: modal stiffness on the diagonal; springs of the magnetic bearings (negative if
  // they attract) and k_i P of their laws; k of the films at Omega, with cross-coupling; the
  // circulatory part of rotating damping, Omega N_xy in the rows of x and columns of y,
  // -Omega N_xy^T in the rows of y and columns of x.
  Eigen::MatrixXd stiffness;
};

// speed: Omega, rad/s, either sign. Magnetic bearings enter with their linear laws without limits,
// if they work at t = 0; their integrators are left out.
LinearParts linear_parts(const Model& model, double speed);

// K + i w C - w^2 M, N/m, 2 n x 2 n: the amplitude of the force over the amplitude of q at the
// frequency w, rad/s.
Eigen::MatrixXcd dynamic_stiffness(const LinearParts& parts, double w);

}  // namespace rotorub
