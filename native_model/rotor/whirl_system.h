// The rotor's linear equations at constant spin speed Omega, for eigenvalue analysis, in
// coordinates of unit mass (n in each plane):
//
//   x'' + (D_x + N_xx) x' + K_x x + Omega G y'   + Omega N_xy y   = 0
//   y'' + (D_y + N_yy) y' + K_y y - Omega G^T x' - Omega N_xy^T x = 0
//
// D: external damping with the bearings'; N: internal (rotating) damping; K with the negative
// stiffness of a magnetic bearing. Geometry form: the untruncated Ritz model, every mode of it
// damped by the damping ratios; modal form: the modes stated.
#pragma once

#include <Eigen/Core>

#include "native_model/scene/scene.h"

namespace rotorub {

struct WhirlSystem {
  Eigen::MatrixXd stiffness_x, stiffness_y;               // 1/s^2, n x n, symmetric
  Eigen::MatrixXd damping_x, damping_y;                   // 1/s, n x n, symmetric, >= 0
  Eigen::MatrixXd gyroscopic;                             // 1, n x n
  Eigen::MatrixXd internal_xx, internal_xy, internal_yy;  // 1/s, n x n
  int kept = 0;            // modes of interest in each plane: those with the lowest frequencies
  bool isotropic = false;  // both planes the same: one complex equation in x + i y
  Eigen::Index size() const { return stiffness_x.rows(); }
};

// Throws scene::SceneError as modal_rotor does.
WhirlSystem whirl_system(const scene::Scene& scene);

}  // namespace rotorub
