#include "native_model/rotor/ritz_bending.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/rotor/refusal.h"
#include "native_model/rotor/shaft_basis.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/text.h"

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
        (geometry.bearings.empty()
             ? std::string("no bearing supports the shaft")
             : std::string("leaves the shaft free to move as a rigid body in plane ") +
                   (plane == 0 ? "x" : "y")) +
            "; give bearings with stiffness > 0 at two stations or more, or at one beside a "
            "[magnetic_bearing] with a control, or two such magnetic bearings"}});
}

bool is_sheared(const scene::RotorGeometry& geometry) {
  return geometry.theory == scene::ShaftTheory::kTimoshenko;
}

double shear_coefficient(const scene::RotorGeometry& geometry, const ShaftElement& element,
                         double z) {
  const double nu = 0.5 * geometry.E / geometry.G - 1.0;
  return geometry.shear_coefficient.value_or(
      cowper_coefficient(nu, element.section.inner_at(z) / element.section.outer_at(z)));
}

// sum += a u^T u + b v^T v. Only the functions that are not 0 in u or v are visited, which are few:
// those of one element and the rigid and linear parts of the others.
void add_squares(double a, const Eigen::RowVectorXd& u, double b, const Eigen::RowVectorXd& v,
                 Eigen::MatrixXd& sum) {
  std::vector<Eigen::Index> at;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    if (u[i] != 0.0 || v[i] != 0.0) at.push_back(i);
  }
  for (const Eigen::Index j : at) {
    for (const Eigen::Index i : at) sum(i, j) += a * u[i] * u[j] + b * v[i] * v[j];
  }
}

// int u_z'u_z dz: the stiffness by a tension of 1 N.
Eigen::MatrixXd slope_integral(const BendingBasis& basis) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(basis.size(), basis.size());
  for (const ShaftElement& element : basis.mesh()) {
    for_each_point(element, element.functions + 1, [&](double z, double, double weight) {
      const Eigen::RowVectorXd u_z = basis.slope(z);
      add_squares(0.5 * element.length() * weight, u_z, 0.0, u_z, sum);
    });
  }
  return sum;
}

// Adds the axial force to both planes, and refuses a shaft that buckles under it.
void add_axial_force(double force, RitzBending& ritz) {
  const Eigen::MatrixXd unit = slope_integral(ritz.basis);
  const auto buckling_load = [&](const Eigen::MatrixXd& K) {
    const Eigen::VectorXd compliance =
        found_by(symmetric_eigenvalues(unit, K), "no buckling load of the shaft can be found");
    return 1.0 / compliance.maxCoeff();
  };
  const double most = std::min(buckling_load(ritz.stiffness_x), buckling_load(ritz.stiffness_y));
  if (!(force > -most)) {
    throw scene::SceneError(
        {{"", 0, "rotor.axial_force",
          "makes the shaft buckle, which happens at " + scene::number_text(-most, 6) +
              " N; give a force above that, not " + scene::number_text(force, 6) + " N"}});
  }
  ritz.stiffness_x += force * unit;
  ritz.stiffness_y += force * unit;
}

// Adds M, G and the gravity load of the shaft itself. The Gauss quadrature is exact for every
// product.
void add_shaft(const scene::RotorGeometry& geometry, RitzBending& ritz) {
  for (const ShaftElement& element : ritz.basis.mesh()) {
    for_each_point(element, element.functions + 2, [&](double z, double, double weight) {
      const double dz = 0.5 * element.length() * weight;
      const Eigen::RowVectorXd u = ritz.basis.deflection(z);
      const Eigen::RowVectorXd p = ritz.basis.tilt(z);
      const double mass = geometry.rho * element.area(z) * dz;
      const double tilt = geometry.rho * element.inertia(z) * dz;
      add_squares(mass, u, tilt, p, ritz.mass);
      add_squares(0.0, u, 2.0 * tilt, p, ritz.gyroscopic);
      ritz.gravity += mass * u.transpose();
    });
  }
}

void add_discs(const scene::RotorGeometry& geometry, RitzBending& ritz) {
  for (const scene::Disc& disc : geometry.discs) {
    const Eigen::RowVectorXd u = ritz.basis.deflection(disc.z);
    const Eigen::RowVectorXd p = ritz.basis.tilt(disc.z);
    ritz.mass += disc.mass * u.transpose() * u + disc.Jt * p.transpose() * p;
    ritz.gyroscopic += disc.Jp * p.transpose() * p;
    ritz.gravity += disc.mass * u.transpose();
  }
}

std::vector<BearingRows> bearing_rows(const scene::RotorGeometry& geometry,
                                      const BendingBasis& basis) {
  std::vector<BearingRows> all;
  int pedestals = 0;
  for (const scene::ShaftBearing& bearing : geometry.bearings) {
    BearingRows& rows = all.emplace_back(BearingRows{basis.deflection(bearing.z), {}});
    if (!bearing.pedestal) continue;
    rows.pedestal = basis.other(pedestals++);
    rows.relative -= rows.pedestal;
  }
  return all;
}

void add_pedestals(const scene::RotorGeometry& geometry, RitzBending& ritz) {
  for (std::size_t i = 0; i < ritz.bearings.size(); ++i) {
    const auto& pedestal = geometry.bearings[i].pedestal;
    const Eigen::RowVectorXd& p = ritz.bearings[i].pedestal;
    if (pedestal) ritz.mass += pedestal->mass * p.transpose() * p;
  }
}

Eigen::MatrixXd stiffness(const scene::RotorGeometry& geometry, const BendingBasis& basis,
                          const std::vector<BearingRows>& bearings, int plane) {
  Eigen::MatrixXd K = geometry.E * basis.curvature_integral();
  if (is_sheared(geometry)) {
    K += geometry.G * basis.shear_integral([&](const ShaftElement& element, double z) {
      return shear_coefficient(geometry, element, z) * element.area(z);
    });
  }
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    const scene::ShaftBearing& bearing = geometry.bearings[i];
    const auto& [u, p] = bearings[i];
    K += bearing.stiffness[plane] * u.transpose() * u;
    if (bearing.pedestal) K += bearing.pedestal->stiffness[plane] * p.transpose() * p;
  }
  return K;
}

}  // namespace

std::vector<ShaftElement> bending_mesh(const scene::RotorGeometry& geometry,
                                       const std::vector<double>& stations, double omega) {
  std::vector<double> nodes = stations;
  for (const scene::Disc& disc : geometry.discs) nodes.push_back(disc.z);
  for (const scene::ShaftBearing& bearing : geometry.bearings) nodes.push_back(bearing.z);
  // Bending wave: E I k^4 = rho A omega^2. With an axial force N the wave numbers of a shaft
  // without shear are the roots of k^4 +- (N / E I) k^2 = rho A omega^2 / E I. A Timoshenko shaft
  // has the wave numbers k^2 = a +- sqrt(a^2 (1 - 4 r / (1 + r)^2) + rho A omega^2 / E I), with r =
  // k G / E and a = rho omega^2 (1 / E + 1 / k G) / 2. The bound with both is never too small.
  std::vector<ShaftElement> mesh = shaft_mesh(geometry, nodes, [&](const ShaftElement& element) {
    // On a cone the wave is shortest at an end, where A / I is largest.
    const auto slenderness = [&](double z) {
      return element.area(z) / (geometry.E * element.inertia(z));
    };
    const double most = std::max(slenderness(element.from), slenderness(element.to));
    double half = 0.0;  // 1/m^2
    if (geometry.axial_force != 0.0) {
      half += 0.5 * std::abs(geometry.axial_force) /
              (geometry.E * std::min(element.inertia(element.from), element.inertia(element.to)));
    }
    if (is_sheared(geometry)) {
      const double modulus =
          geometry.G * std::min(shear_coefficient(geometry, element, element.from),
                                shear_coefficient(geometry, element, element.to));
      half += 0.5 * geometry.rho * omega * omega * (1.0 / geometry.E + 1.0 / modulus);
    }
    return std::sqrt(half + std::sqrt(half * half + omega * omega * geometry.rho * most));
  });
  if (is_sheared(geometry)) {
    for (ShaftElement& element : mesh) element.shear_functions = element.functions;
  }
  return mesh;
}

RitzBending ritz_bending(const scene::RotorGeometry& geometry, std::vector<ShaftElement> mesh) {
  const auto [first_x, last_x] = supports(geometry, 0);
  const auto [first_y, last_y] = supports(geometry, 1);
  const auto pedestals = std::ranges::count_if(
      geometry.bearings, [](const scene::ShaftBearing& b) { return b.pedestal.has_value(); });
  BendingBasis basis(std::move(mesh), std::min(first_x, first_y), std::max(last_x, last_y),
                     static_cast<int>(pedestals));
  const int n = basis.size();
  std::vector<BearingRows> bearings = bearing_rows(geometry, basis);
  RitzBending ritz{std::move(basis),
                   std::move(bearings),
                   Eigen::MatrixXd::Zero(n, n),
                   Eigen::MatrixXd::Zero(n, n),
                   {},
                   {},
                   Eigen::VectorXd::Zero(n)};
  add_shaft(geometry, ritz);
  add_discs(geometry, ritz);
  add_pedestals(geometry, ritz);
  ritz.stiffness_x = stiffness(geometry, ritz.basis, ritz.bearings, 0);
  ritz.stiffness_y = stiffness(geometry, ritz.basis, ritz.bearings, 1);
  if (geometry.axial_force != 0.0) add_axial_force(geometry.axial_force, ritz);
  ritz.isotropic = ritz.stiffness_x == ritz.stiffness_y;
  return ritz;
}

}  // namespace rotorub
