// The shaft for a Ritz ansatz: the places on it that a scene names, elements fine enough for a
// given frequency, and the admissible functions on them.
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
  std::string name;  // "disc 1", "bearing 2", "contact", ...; no number where there is one alone
  double z;          // m
};

// "disc 2", of index 1 among several; "disc" of one alone.
std::string numbered(const char* name, std::size_t index, std::size_t count);

// Of a rotor in geometry form: bearings, discs, contacts, drive, magnetic bearing, forces.
std::vector<Station> stations_of(const scene::Scene& scene);

// One element of the shaft, a cylinder or a cone, with the number of Legendre functions that carry
// its curvature (bending) or its twist per length (torsion). Two functions of curvature are the
// Hermite cubic beam element.
struct ShaftElement {
  double from, to;              // m
  scene::ShaftSection section;  // of which it is a part
  int functions = 0;            // >= 1
  double length() const { return to - from; }
  bool tapered() const { return section.tapered(); }
  // At z in [from, to]: m^2, and m^4, I, the second moment of area; the polar one is 2 I.
  double area(double z) const;
  double inertia(double z) const;
};

// Powers of z up to which area and I of a cone go: what a quadrature must be exact for beside them.
inline constexpr int kTaperDegree = 4;

// Elements end at every change of section and at every station given (m, in [0, length]): there the
// solution has a kink in some derivative. wave_number (1/m, of an element): k of the shortest wave
// to be resolved; elements are cut until k h <= 4 and get as many functions as a wave of that
// length needs for frequencies right to round-off.
// Throws scene::SceneError where the mesh would be beyond any sensible size.
std::vector<ShaftElement> shaft_mesh(const scene::RotorGeometry& geometry,
                                     std::vector<double> stations,
                                     const std::function<double(const ShaftElement&)>& wave_number);

// Functions of all elements.
int function_count(const std::vector<ShaftElement>& mesh);

// Solves on finer meshes until the highest frequency asked for is below the one that the mesh was
// made for. solve(omega) meshes for omega (rad/s), and returns a result with
// `double highest() const`: the highest frequency asked for; infinite where the mesh has too few
// functions for the number of modes asked for.
template <typename Solve>
auto solve_refined(double omega, const Solve& solve) {
  constexpr double kGrowth = 4.0;   // where nothing is known of the frequency yet
  constexpr double kMargin = 1.05;  // Ritz frequencies fall as the mesh grows finer
  while (true) {
    auto result = solve(omega);
    const double highest = result.highest();
    if (highest <= omega) return result;
    omega = highest < kGrowth * omega ? kMargin * highest : kGrowth * omega;
  }
}

// Legendre polynomials P_n on [-1, 1], their integrals from -1, and Gauss-Legendre quadrature:
// the local functions of the Ritz ansatz. Identities: Abramowitz and Stegun, chapters 8 and 25.4.

// P_n and its first and second integral from -1 to xi, for n = 0 .. count - 1.
// For n >= 2 both integrals vanish at xi = 1, so that they are bubbles of one element.
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

// Calls add(z, node, weight) for the points of a rule that is exact for the element's section times
// polynomials in z up to degree 2 (points - 1) + 1; dz is half the element's length times weight.
template <typename Add>
void for_each_point(const ShaftElement& element, int points, const Add& add) {
  const GaussRule rule = gauss_legendre(points + (element.tapered() ? kTaperDegree / 2 : 0));
  for (int i = 0; i < rule.node.size(); ++i) {
    add(element.from + 0.5 * element.length() * (1.0 + rule.node[i]), rule.node[i], rule.weight[i]);
  }
}

// Admissible functions of the Ritz ansatz (1), as rows u(z) over the coordinates.
//
// The curvature (bending) or the twist per length (torsion) is, in every element, a sum of Legendre
// polynomials; deflection and angle are its integrals. With m functions in an element the bending
// space is that of the C1 finite elements of degree m + 1 (m = 2: Hermite cubics). The stiffness of
// a shaft of cylinders is then exactly diagonal, and rigid motion is stored apart from it: neither
// very short elements nor very stiff bearings cost digits.

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
