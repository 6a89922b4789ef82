// Matrices of the bending Ritz ansatz, equation (1) of the paper before modal reduction:
//
//   M = int rho A u'u + rho I p'p dz + sum m u'u + J_t p'p
//   G = int 2 rho I p'p dz + sum J_p p'p        (I_p = 2 I)
//   K = int E I p_z'p_z + G k A g'g + N u_z'u_z dz + sum k u'u
//
// With a pedestal under a bearing, u there is the deflection relative to it, and the pedestal's own
// displacement is a further coordinate, with its mass in M and its spring in K.
//
// u, p: rows of shape functions and of the angles of the cross-sections; g = u_z - p: shear
// strains, 0 for an Euler-Bernoulli shaft (BendingBasis). k: shear coefficient; N: axial force. All
// integrals are exact. (The bore of a cone may change its shear coefficient; its integral is exact
// to round-off.)
#pragma once

#include <Eigen/Core>
#include <vector>

#include "native_model/rotor/shaft_basis.h"
#include "native_model/scene/rotor.h"

namespace rotorub {

// Rows over the coordinates of a bearing: what its law acts on, the deflection of the shaft
// relative to the pedestal, and the displacement of the pedestal; empty without one.
struct BearingRows {
  Eigen::RowVectorXd relative, pedestal;
};

struct RitzBending {
  BendingBasis basis;
  std::vector<BearingRows> bearings;         // of the geometry
  Eigen::MatrixXd mass;                      // N x N, symmetric, positive definite
  Eigen::MatrixXd gyroscopic;                // N x N, symmetric, >= 0
  Eigen::MatrixXd stiffness_x, stiffness_y;  // N x N, symmetric, positive definite
  Eigen::VectorXd gravity;  // N, load per unit acceleration: int rho A u dz + sum m u
  bool isotropic = true;    // the stiffness is bitwise equal in x and y
};

// Mesh for bending waves up to omega (rad/s). Elements end at discs, bearings and `stations` (m).
std::vector<ShaftElement> bending_mesh(const scene::RotorGeometry& geometry,
                                       const std::vector<double>& stations, double omega);

// Throws scene::SceneError if a plane is not supported at two stations, or if the axial force makes
// the shaft buckle.
RitzBending ritz_bending(const scene::RotorGeometry& geometry, std::vector<ShaftElement> mesh);

}  // namespace rotorub
