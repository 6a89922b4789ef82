// The linear part of bending at a held spin speed Omega, both planes at once (x_1..x_n, y_1..y_n):
//
//   M q'' + C q' + K q = loads
//
// Every column is what the list of loads (loads.h) gives for a unit of one coordinate, so that no
// load can be in one and not in the other.
#pragma once

#include <Eigen/Core>

#include "native_model/model/model.h"

namespace rotorub {

struct LinearParts {
  // kg, 2 n, > 0: the diagonal of M (model.h).
  Eigen::VectorXd mass;
  // N s/m, 2 n x 2 n. External damping of the modes on the diagonal, D >= 0; dashpots of the
  // bearings; c of the films at Omega; k_i D of a magnetic bearing's law; rotating damping N_xx,
  // N_yy; gyroscopic Omega G in the rows of x and columns of y, -Omega G^T in those of y and x.
  Eigen::MatrixXd damping;
  // N/m, 2 n x 2 n. Of the modes on the diagonal; a magnetic bearing's springs, negative where it
  // pulls, and its law k_i P; k of the films at Omega, across the planes too; the circulatory part
  // of rotating damping, Omega N_xy in the rows of x and columns of y, -Omega N_xy^T in those of y
  // and x.
  Eigen::MatrixXd stiffness;
};

// speed: Omega, rad/s, either sign. Of a magnetic bearing the linear law of t = 0: without its
// limit, and nothing of one that has failed by then; what its integrator holds is not in it.
LinearParts linear_parts(const Model& model, double speed);

}  // namespace rotorub
