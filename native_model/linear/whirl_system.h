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

#include <vector>

#include "native_model/bearing/bearing_film.h"
#include "native_model/rotor/modal_rotor.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// K and C of a bearing beyond what the matrices have of it, at its station: films add
// u u^T k_xx(Omega) to the rows of x and columns of x, u u^T k_xy(Omega) to those of x and y, ...
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
  int kept = 0;            // modes of interest in each plane: those with the lowest frequencies
  bool isotropic = false;  // both planes the same: one complex equation in x + i y
  Eigen::Index size() const { return stiffness_x.rows(); }
};

// q'' + damping q' + stiffness q = 0 at a speed: both planes, 2 n, or of planes that are the same x
// + i y, n.
struct WhirlMatrices {
  Eigen::MatrixXcd damping, stiffness;
};
WhirlMatrices isotropic_matrices(const WhirlSystem& system, double speed);
struct PlanesMatrices {
  Eigen::MatrixXd damping, stiffness;
};
PlanesMatrices planes_matrices(const WhirlSystem& system, double speed);

// Throws scene::SceneError as modal_rotor does.
WhirlSystem whirl_system(const scene::Scene& scene);

}  // namespace rotorub
