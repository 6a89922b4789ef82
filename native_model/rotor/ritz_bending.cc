#include "native_model/rotor/ritz_bending.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "native_model/rotor/shaft_basis.h"
#include "native_model/scene/diagnostic.h"

namespace rotorub {
namespace {

// The outermost stations with a stiffness in the plane. If they coincide, the shaft is a mechanism.
std::pair<double, double> supports(const scene::RotorGeometry& geometry, int plane) {
  double first = std::numeric_limits<double>::infinity();
  double last = -first;
  for (const scene::ShaftBearing& bearing : geometry.bearings) {
    if (!(bearing.stiffness[plane] > 0.0)) continue;
    first = std::min(first, bearing.z);
    last = std::max(last, bearing.z);
  }
  if (first < last) return {first, last};
  throw scene::SceneError(
      {{"", 0, "rotor.bearing",
        std::string("leaves the shaft free to move as a rigid body in plane ") +
            (plane == 0 ? "x" : "y") +
            "; accepted: bearings with stiffness > 0 at two stations or more, or at one beside a "
            "[magnetic_bearing] with a control, or two of those"}});
}

// Adds M, G and the gravity load of the shaft itself. The Gauss quadrature is exact for every
// product.
void add_shaft(const scene::RotorGeometry& geometry, RitzBending& ritz) {
  for (const ShaftElement& element : ritz.basis.mesh()) {
    for_each_point(element, element.functions + 2, [&](double z, double, double weight) {
      const double dz = 0.5 * element.length() * weight;
      const Eigen::RowVectorXd u = ritz.basis.deflection(z);
      const Eigen::RowVectorXd u_z = ritz.basis.slope(z);
      const double mass = geometry.rho * element.area(z) * dz;
      const double tilt = geometry.rho * element.inertia(z) * dz;
      ritz.mass += mass * u.transpose() * u + tilt * u_z.transpose() * u_z;
      ritz.gyroscopic += 2.0 * tilt * u_z.transpose() * u_z;
      ritz.gravity += mass * u.transpose();
    });
  }
}

void add_discs(const scene::RotorGeometry& geometry, RitzBending& ritz) {
  for (const scene::Disc& disc : geometry.discs) {
    const Eigen::RowVectorXd u = ritz.basis.deflection(disc.z);
    const Eigen::RowVectorXd u_z = ritz.basis.slope(disc.z);
    ritz.mass += disc.mass * u.transpose() * u + disc.Jt * u_z.transpose() * u_z;
    ritz.gyroscopic += disc.Jp * u_z.transpose() * u_z;
    ritz.gravity += disc.mass * u.transpose();
  }
}

Eigen::MatrixXd stiffness(const scene::RotorGeometry& geometry, const BendingBasis& basis,
                          int plane) {
  Eigen::MatrixXd K = geometry.E * basis.curvature_integral();
  for (const scene::ShaftBearing& bearing : geometry.bearings) {
    const Eigen::RowVectorXd u = basis.deflection(bearing.z);
    K += bearing.stiffness[plane] * u.transpose() * u;
  }
  return K;
}

}  // namespace

std::vector<ShaftElement> bending_mesh(const scene::RotorGeometry& geometry,
                                       const std::vector<double>& stations, double omega) {
  std::vector<double> nodes = stations;
  for (const scene::Disc& disc : geometry.discs) nodes.push_back(disc.z);
  for (const scene::ShaftBearing& bearing : geometry.bearings) nodes.push_back(bearing.z);
  // Bending wave: E I k^4 = rho A omega^2.
  return shaft_mesh(geometry, nodes, [&](const ShaftElement& element) {
    // On a cone the wave is shortest at an end, where A / I is largest.
    const auto slenderness = [&](double z) {
      return element.area(z) / (geometry.E * element.inertia(z));
    };
    const double most = std::max(slenderness(element.from), slenderness(element.to));
    return std::sqrt(std::sqrt(omega * omega * geometry.rho * most));
  });
}

RitzBending ritz_bending(const scene::RotorGeometry& geometry, std::vector<ShaftElement> mesh) {
  const auto [first_x, last_x] = supports(geometry, 0);
  const auto [first_y, last_y] = supports(geometry, 1);
  BendingBasis basis(std::move(mesh), std::min(first_x, first_y), std::max(last_x, last_y));
  const int n = basis.size();
  RitzBending ritz{
      std::move(basis),        Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), {}, {},
      Eigen::VectorXd::Zero(n)};
  add_shaft(geometry, ritz);
  add_discs(geometry, ritz);
  ritz.stiffness_x = stiffness(geometry, ritz.basis, 0);
  ritz.stiffness_y = stiffness(geometry, ritz.basis, 1);
  ritz.isotropic = ritz.stiffness_x == ritz.stiffness_y;
  return ritz;
}

}  // namespace rotorub
