// The rotor's linear equations at constant spin speed Omega, for eigenvalue analysis, in
// coordinates of unit mass (n in each plane):
//
//   x'' + (D_x + N_xx) x' + K_x x + Omega G y'   + Omega N_xy y   = 0
//   y'' + (D_y + N_yy) y' + K_y y - Omega G^T x' - Omega N_xy^T x = 0
//
// D: external damping, including the bearings; N: internal (rotating) damping; K includes the
// negative stiffness of a magnetic bearing. Geometry form: the untruncated Ritz model, with the
// damping ratios applied to all of its modes. Modal form: the modes given in the scene.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "native_model/bearing/bearing_film.h"
#include "native_model/rotor/modal_rotor.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// K and C of a bearing beyond its constant uncoupled part in the matrices: a film at station u adds
// u u^T k_xx(Omega) to the block of x rows and x columns, u u^T k_xy(Omega) to that of x rows and y
// columns, and so on.
struct WhirlFilm {
  Eigen::VectorXd station;  // n, u
  BearingFilm law;
};

struct WhirlSystem {
  Eigen::MatrixXd stiffness_x, stiffness_y;               // 1/s^2, n x n, symmetric
  Eigen::MatrixXd damping_x, damping_y;                   // 1/s, n x n, symmetric, >= 0
  Eigen::MatrixXd gyroscopic;                             // 1, n x n
  Eigen::MatrixXd internal_xx, internal_xy, internal_yy;  // 1/s, n x n
  std::vector<WhirlFilm> films;
  std::vector<ModeShape> contacts;  // n each: values of the coordinates at each auxiliary bearing
  int kept = 0;                     // number of lowest modes of interest in each plane
  bool isotropic = false;           // both planes are the same: one complex equation in x + i y
  Eigen::Index size() const { return stiffness_x.rows(); }
};

// q'' + damping q' + stiffness q = 0 at a speed: n complex coordinates x + i y if the planes are
// the same (isotropic_matrices), else 2 n of both planes (planes_matrices).
struct WhirlMatrices {
  Eigen::MatrixXcd damping, stiffness;
};
WhirlMatrices isotropic_matrices(const WhirlSystem& system, double speed);
struct PlanesMatrices {
  Eigen::MatrixXd damping, stiffness;
};
PlanesMatrices planes_matrices(const WhirlSystem& system, double speed);

// B^T A B for a symmetric A, symmetric to the last bit, so that equal planes compare as equal.
Eigen::MatrixXd projected(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

// Throws scene::SceneError as modal_rotor does.
WhirlSystem whirl_system(const scene::Scene& scene);

}  // namespace rotorub
