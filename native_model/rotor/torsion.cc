#include "native_model/rotor/torsion.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "native_model/rotor/legendre.h"
#include "native_model/rotor/modal_reduction.h"
#include "native_model/rotor/mode_scaling.h"
#include "native_model/rotor/planar_modes.h"
#include "native_model/rotor/powers.h"
#include "native_model/rotor/shaft_basis.h"

namespace rotorub {
namespace {

// Calls add(z, J) for every polar inertia J (kg m^2) along the shaft: quadrature points of the
// shaft itself, discs, motor.
template <typename Add>
void for_each_inertia(const scene::Scene& scene, const std::vector<ShaftElement>& mesh,
                      const Add& add) {
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  for (const ShaftElement& element : mesh) {
    const GaussRule rule =
        gauss_legendre(element.functions + 1 + (element.tapered() ? kTaperDegree / 2 : 0));
    for (int i = 0; i < rule.node.size(); ++i) {
      const double z = element.from + 0.5 * element.length() * (1.0 + rule.node[i]);
      add(z, geometry.rho * 2.0 * element.inertia(z) * 0.5 * element.length() * rule.weight[i]);
    }
  }
  for (const scene::Disc& disc : geometry.discs) add(disc.z, disc.Jp);
  if (scene.drive) add(scene.drive->station, scene.drive->inertia);
}

struct TorsionSolution {
  TorsionBasis basis;
  PlanarModes modes;
  int wanted;
  // rad/s, see solve_refined
  double highest() const {
    return wanted > basis.size() ? std::numeric_limits<double>::infinity()
                                 : modes.frequency[wanted - 1];
  }
};

TorsionSolution solve_torsion(const scene::Scene& scene, double omega) {
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  std::vector<double> stations;
  for (const scene::Disc& disc : geometry.discs) stations.push_back(disc.z);
  if (scene.drive) stations.push_back(scene.drive->station);
  // Torsional wave: G k^2 = rho omega^2.
  TorsionBasis basis(shaft_mesh(geometry, stations, [&](const ShaftElement&) {
    return omega * std::sqrt(geometry.rho / geometry.G);
  }));

  // Free shaft: without the share of the rigid spin the elastic part has no angular momentum, so
  // that the two are orthogonal. The row of the shaft held at z = 0 needs no offset.
  if (scene.drive) {
    Eigen::RowVectorXd momentum = Eigen::RowVectorXd::Zero(basis.size());
    double total = 0.0;
    for_each_inertia(scene, basis.mesh(), [&](double z, double J) {
      momentum += J * basis.angle(z);
      total += J;
    });
    basis.set_offset(momentum / total);
  }

  Eigen::MatrixXd inertia = Eigen::MatrixXd::Zero(basis.size(), basis.size());
  for_each_inertia(scene, basis.mesh(), [&](double z, double J) {
    const Eigen::RowVectorXd theta = basis.angle(z);
    inertia += J * theta.transpose() * theta;
  });
  const Eigen::MatrixXd stiffness = geometry.G * basis.twist_integral();
  PlanarModes modes = planar_modes(inertia, stiffness);
  return {std::move(basis), std::move(modes), scene.rotor.torsion->modes};
}

}  // namespace

double spin_inertia(const scene::Scene& scene) {
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  double inertia = scene.drive ? scene.drive->inertia : 0.0;
  for (const scene::ShaftSection& section : geometry.sections) {
    // The mean of d^4 over a cone's length is (a^4 + a^3 b + a^2 b^2 + a b^3 + b^4) / 5.
    const auto mean = [](double a, double b) {
      return a == b ? fourth(a) : ((a * a + b * b) * (a * a + a * b + b * b) - a * a * b * b) / 5.0;
    };
    const double polar = std::numbers::pi / 32.0 *
                         (mean(section.diameter, section.outer_at(section.to)) -
                          mean(section.inner_diameter, section.inner_at(section.to)));
    inertia += geometry.rho * polar * (section.to - section.from);
  }
  for (const scene::Disc& disc : geometry.discs) inertia += disc.Jp;
  return inertia;
}

TorsionModes torsion_modes(const scene::Scene& scene) {
  if (!scene.rotor.torsion) return no_torsion(scene.auxiliary.size());
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  const int wanted = scene.rotor.torsion->modes;
  assert(wanted >= 1);
  const double uniform =
      wanted * std::numbers::pi / geometry.length * std::sqrt(geometry.G / geometry.rho);
  const TorsionSolution solution =
      solve_refined(uniform, [&](double omega) { return solve_torsion(scene, omega); });

  const std::optional<double> contact =
      scene.first().contact ? std::optional<double>(scene.first().contact->station) : std::nullopt;
  const std::vector<double> stations = line_stations(solution.basis.mesh());
  const Eigen::Index n = wanted;
  TorsionModes result{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n),
                      Eigen::VectorXd(n),
                      std::vector<Eigen::VectorXd>(scene.auxiliary.size(), Eigen::VectorXd(n))};
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::VectorXd mode = solution.modes.shape.col(j);  // of unit inertia
    const auto angle = [&](double z) { return solution.basis.angle(z).dot(mode); };
    const ModeScale scale = mode_scale(angle, stations, contact);
    const double omega = solution.modes.frequency[j];
    result.inertia[j] = scale.factor * scale.factor;
    result.stiffness[j] = result.inertia[j] * omega * omega;
    result.damping[j] = 2.0 * scene.rotor.torsion->damping_ratio * result.inertia[j] * omega;
    // Held at the motor's station there is no motion of the motor.
    result.drive_shape[j] = scene.drive ? scale.factor * angle(scene.drive->station) : 0.0;
    result.contacts.front()[j] = scale.contact;
    for (std::size_t k = 1; k < scene.auxiliary.size(); ++k) {
      result.contacts[k][j] = scale.factor * angle(scene.auxiliary[k].contact->station);
    }
  }
  return result;
}

}  // namespace rotorub
