// Admissible functions of the Ritz ansatz (1), as rows u(z) over the coordinates.
//
// The curvature (bending) or the twist per length (torsion) is, in every element, a sum of Legendre
// polynomials; deflection and angle are its integrals. With m functions in an element the bending
// space is that of the C1 finite elements of degree m + 1 (m = 2: Hermite cubics). The stiffness of
// a shaft of cylinders is then exactly diagonal, and rigid motion is stored apart from it: neither
// very short elements nor very stiff bearings cost digits.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "native_model/rotor/shaft_mesh.h"

namespace rotorub {

// Deflection u(z) = a (z_b - z)/(z_b - z_a) + b (z - z_a)/(z_b - z_a) + elastic part, the elastic
// part being 0 at the anchors z_a, z_b. Coordinates: a, b (m), then the curvatures (1/m).
class BendingBasis {
 public:
  // Anchors in [0, length], first < second.
  BendingBasis(std::vector<ShaftElement> mesh, double first_anchor, double second_anchor);

  int size() const { return 2 + function_count(mesh_); }
  const std::vector<ShaftElement>& mesh() const { return mesh_; }

  Eigen::RowVectorXd deflection(double z) const;  // 1, u
  Eigen::RowVectorXd slope(double z) const;       // 1/m, u_z
  // int I u_zz u_zz' (size x size): m^4 / m^3 per squared coordinate, to be multiplied by E.
  // Diagonal but for cones, each of which has a block.
  Eigen::MatrixXd curvature_integral() const;

 private:
  Eigen::RowVectorXd raw(double z, int derivative) const;

  std::vector<ShaftElement> mesh_;
  double first_, second_;                            // m, anchors
  Eigen::RowVectorXd raw_at_first_, raw_at_second_;  // deflection without the correction
};

// Twist angle theta(z) = int_0^z of the twist per length, minus an offset row: what is held, or the
// share of the rigid rotation. Coordinates: twists per length (rad/m).
class TorsionBasis {
 public:
  explicit TorsionBasis(std::vector<ShaftElement> mesh);

  int size() const { return function_count(mesh_); }
  const std::vector<ShaftElement>& mesh() const { return mesh_; }
  void set_offset(const Eigen::RowVectorXd& offset) { offset_ = offset; }

  Eigen::RowVectorXd angle(double z) const;
  // int 2 I theta_z theta_z' (size x size), to be multiplied by G; as above.
  Eigen::MatrixXd twist_integral() const;

 private:
  std::vector<ShaftElement> mesh_;
  Eigen::RowVectorXd offset_;
};

}  // namespace rotorub
