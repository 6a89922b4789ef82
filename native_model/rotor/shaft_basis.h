// The shaft for a Ritz ansatz: the stations that a scene names, elements fine enough for a given
// frequency, and the admissible functions on them.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "native_model/scene/forward.h"
#include "native_model/scene/rotor.h"

namespace rotorub {

enum class StationKind { kDisc, kBearing, kContact, kDrive, kMagneticBearing, kForce };

// A place on the shaft that the scene names.
struct Station {
  StationKind kind;
  std::string name;  // "disc 1", "bearing 2", "contact", ...; no number if there is only one
  double z;          // m
};

// "disc 2" for index 1 of several discs; "disc" if count is 1.
std::string numbered(const char* name, std::size_t index, std::size_t count);

// Stations of a rotor in geometry form: bearings, discs, contacts, drive, magnetic bearings and
// their sensors, forces.
std::vector<Station> stations_of(const scene::Scene& scene);

// One element of the shaft, a cylinder or a cone, with the number of Legendre functions for its
// curvature (bending) or its twist per length (torsion), and of those for its shear strain. With
// two functions of curvature alone it is the Hermite cubic beam element.
struct ShaftElement {
  double from, to;              // m
  scene::ShaftSection section;  // the section that contains the element
  int functions = 0;            // >= 1
  int shear_functions = 0;      // >= 0; 0: no shear deformation
  int all_functions() const { return functions + shear_functions; }
  double length() const { return to - from; }
  bool tapered() const { return section.tapered(); }
  // At z in [from, to]: area in m^2, and second moment of area I in m^4; the polar moment is 2 I.
  double area(double z) const;
  double inertia(double z) const;
};

// Shear coefficient of a circular section with the bore `ratio` = inner / outer diameter, in [0,
// 1):
//   k = 6 (1 + nu) (1 + ratio^2)^2 / ((7 + 6 nu) (1 + ratio^2)^2 + (20 + 12 nu) ratio^2)
// (G. R. Cowper, "The shear coefficient in Timoshenko's beam theory", J. Applied Mechanics 33,
// 1966).
double cowper_coefficient(double nu, double ratio);

// Degree in z of I on a cone (the area has degree 2). Quadrature must be exact for this factor too.
inline constexpr int kTaperDegree = 4;

// Elements end at every change of section and at every given station (m, in [0, length]), where
// some derivative of the solution has a kink. wave_number (1/m) returns k of the shortest wave to
// be resolved on an element. Elements are cut until k h <= 4, and have as many functions as such a
// wave needs for frequencies accurate to round-off. Throws scene::SceneError if the mesh would need
// too many functions.
std::vector<ShaftElement> shaft_mesh(const scene::RotorGeometry& geometry,
                                     std::vector<double> stations,
                                     const std::function<double(const ShaftElement&)>& wave_number);

// Total number of functions of all elements, shear included.
int function_count(const std::vector<ShaftElement>& mesh);

// Solves on finer and finer meshes until the highest requested frequency is below the frequency for
// which the mesh was made. solve(omega) makes a mesh for omega (rad/s) and returns a result with
// `double highest() const`: the highest requested frequency, or infinity if the mesh has fewer
// functions than requested modes.
template <typename Solve>
auto solve_refined(double omega, const Solve& solve) {
  constexpr double kGrowth = 4.0;   // used while the frequency is far above omega
  constexpr double kMargin = 1.05;  // Ritz frequencies fall as the mesh becomes finer
  while (true) {
    auto result = solve(omega);
    const double highest = result.highest();
    if (highest <= omega) return result;
    omega = highest < kGrowth * omega ? kMargin * highest : kGrowth * omega;
  }
}

// Local functions of the Ritz ansatz: Legendre polynomials P_n on [-1, 1], their integrals from -1,
// and Gauss-Legendre quadrature. Identities: Abramowitz and Stegun, chapters 8 and 25.4.

// P_n and its first and second integrals from -1 to xi, for n = 0 .. count - 1. For n >= 2 both
// integrals vanish at xi = 1, so they are bubble functions of one element.
struct LegendreValues {
  Eigen::VectorXd value;   // P_n(xi)
  Eigen::VectorXd first;   // int P_n
  Eigen::VectorXd second;  // int int P_n
};

// xi in [-1, 1], count >= 1.
LegendreValues integrated_legendre(int count, double xi);

// sum_i weight_i f(node_i) = int_{-1}^{1} f for polynomials up to degree 2 n - 1.
struct GaussRule {
  Eigen::VectorXd node;    // n, ascending
  Eigen::VectorXd weight;  // n, sum 2
};

// n >= 1 points.
GaussRule gauss_legendre(int n);

// Calls add(z, node, weight) for each point of a quadrature rule on the element, node in [-1, 1]
// being the local coordinate of z. The rule is exact for the element's area or I times a polynomial
// in z of degree up to 2 (points - 1) + 1. dz is half the element's length times weight.
template <typename Add>
void for_each_point(const ShaftElement& element, int points, const Add& add) {
  const GaussRule rule = gauss_legendre(points + (element.tapered() ? kTaperDegree / 2 : 0));
  for (int i = 0; i < rule.node.size(); ++i) {
    add(element.from + 0.5 * element.length() * (1.0 + rule.node[i]), rule.node[i], rule.weight[i]);
  }
}

// Admissible functions of the Ritz ansatz (1), as rows u(z) over the coordinates.
//
// In every element the curvature (bending) or the twist per length (torsion) is a sum of Legendre
// polynomials; deflection and angle are its integrals. With m functions per element the bending
// space equals that of the C1 finite elements of degree m + 1 (m = 2: Hermite cubics). The
// stiffness of a shaft of cylinders is then exactly diagonal, and the rigid motion has coordinates
// of its own, so very short elements and very stiff bearings cost no digits. A Timoshenko shaft has
// the shear strains beside the curvatures in the same way, so that thin shafts do not lock.

// Deflection u(z) = a (z_b - z)/(z_b - z_a) + b (z - z_a)/(z_b - z_a) + elastic part. The elastic
// part is 0 at the anchors z_a, z_b. With the angle psi of the cross-section and the shear strain
// gamma, u_z = psi + gamma, and the curvature is psi_z; without shear gamma = 0. Coordinates: a, b
// (m), then of each element the curvatures (1/m) and the shear strains (1), then the displacements
// of `others` bodies beside the shaft (m).
class BendingBasis {
 public:
  // Anchors (m) in [0, length], first < second.
  BendingBasis(std::vector<ShaftElement> mesh, double first_anchor, double second_anchor,
               int others = 0);

  int size() const { return 2 + function_count(mesh_) + others_; }
  const std::vector<ShaftElement>& mesh() const { return mesh_; }

  Eigen::RowVectorXd deflection(double z) const;  // 1, u
  Eigen::RowVectorXd tilt(double z) const;        // 1/m, psi
  Eigen::RowVectorXd slope(double z) const;       // 1/m, u_z, at a z within an element
  Eigen::RowVectorXd other(int index) const;      // 1, displacement of a body beside the shaft
  // int I psi_z psi_z' dz (size x size; m^5 for the curvatures, 0 for all else), to be multiplied
  // by E. Diagonal except for one block per cone.
  Eigen::MatrixXd curvature_integral() const;
  // int k A gamma gamma' dz (size x size; m^3 for the shear strains, 0 for all else), to be
  // multiplied by G. shear_area(element, z): k A in m^2. Diagonal except for one block per cone.
  Eigen::MatrixXd shear_integral(
      const std::function<double(const ShaftElement&, double)>& shear_area) const;

 private:
  Eigen::RowVectorXd raw_deflection(double z) const;
  Eigen::RowVectorXd raw_tilt(double z) const;

  std::vector<ShaftElement> mesh_;
  double first_, second_;  // m, anchors
  int others_;
  Eigen::RowVectorXd raw_at_first_, raw_at_second_;  // deflection without the correction
};

// Twist angle theta(z) = int_0^z of the twist per length, minus an offset row: the value at the
// held station, or the share of the rigid rotation. Coordinates: twists per length (rad/m).
class TorsionBasis {
 public:
  explicit TorsionBasis(std::vector<ShaftElement> mesh);

  int size() const { return function_count(mesh_); }
  const std::vector<ShaftElement>& mesh() const { return mesh_; }
  void set_offset(const Eigen::RowVectorXd& offset) { offset_ = offset; }

  Eigen::RowVectorXd angle(double z) const;
  // int 2 I theta_z theta_z' dz (size x size, m^5), to be multiplied by G. Diagonal except for one
  // block per cone.
  Eigen::MatrixXd twist_integral() const;

 private:
  std::vector<ShaftElement> mesh_;
  Eigen::RowVectorXd offset_;
};

}  // namespace rotorub
