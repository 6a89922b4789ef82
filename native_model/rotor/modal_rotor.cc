#include "native_model/rotor/modal_rotor.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "native_model/rotor/modal_reduction.h"
#include "native_model/rotor/powers.h"
#include "native_model/rotor/refusal.h"
#include "native_model/rotor/rotor_modes.h"
#include "native_model/rotor/shaft_basis.h"

namespace rotorub {
namespace {

// Converts a list of the scene to a vector of n values; an empty list means `missing` everywhere.
Eigen::VectorXd values(const std::vector<double>& list, std::size_t n, double missing) {
  if (list.empty()) return Eigen::VectorXd::Constant(static_cast<Eigen::Index>(n), missing);
  assert(list.size() == n);
  return Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(n));
}

const std::vector<double>& or_else(const std::vector<double>& list,
                                   const std::vector<double>& other) {
  return list.empty() ? other : list;
}

TorsionModes modal_form_torsion(const scene::Scene& scene) {
  if (!scene.rotor.torsion) return no_torsion(scene.auxiliary.size());
  const scene::Torsion& torsion = *scene.rotor.torsion;
  const std::size_t n = torsion.inertia.size();
  std::vector<Eigen::VectorXd> contacts;
  for (const scene::AuxiliaryBearing& bearing : scene.auxiliary) {
    contacts.push_back(
        values(bearing.contact ? bearing.contact->torsion_shape : std::vector<double>{}, n, 1.0));
  }
  return {values(torsion.inertia, n, 0.0), values(torsion.stiffness, n, 0.0),
          values(torsion.damping, n, 0.0), values(torsion.drive_shape, n, 0.0),
          std::move(contacts)};
}

// Modal form: copies the values of the scene.
ModalRotor modal_form(const scene::Scene& scene) {
  const scene::RotorModal& modal = *scene.rotor.modal;
  const std::size_t n = modal.mass.size();
  const auto shape = [&](const std::vector<double>& list) {
    return ModeShape{values(list, n, 1.0), values(list, n, 1.0)};
  };

  ModalRotor rotor;
  rotor.x = {values(modal.mass, n, 0.0), values(modal.stiffness, n, 0.0),
             values(modal.damping, n, 0.0)};
  rotor.y = {values(or_else(modal.mass_y, modal.mass), n, 0.0),
             values(or_else(modal.stiffness_y, modal.stiffness), n, 0.0),
             values(or_else(modal.damping_y, modal.damping), n, 0.0)};
  for (const scene::AuxiliaryBearing& bearing : scene.auxiliary) {
    rotor.contacts.push_back(
        shape(bearing.contact ? bearing.contact->shape : std::vector<double>{}));
  }
  rotor.gyroscopic = values(modal.gyroscopic, n, 0.0).asDiagonal();
  rotor.internal_xx = rotor.internal_xy = rotor.internal_yy =
      values(modal.internal_damping, n, 0.0).asDiagonal();
  for (const scene::Force& force : scene.forces) rotor.force_shapes.push_back(shape(force.shape));
  for (const scene::MagneticBearing& bearing : scene.magnetic_bearings) {
    MagnetShapes& at = rotor.magnets.emplace_back(MagnetShapes{shape(bearing.shape)});
    if (!bearing.sensor_shape.empty()) at.sensor = shape(bearing.sensor_shape);
  }

  // Without a participation the gravity load of a mode is its modal mass.
  const bool given = scene.gravity && !scene.gravity->participation.empty();
  rotor.gravity_x = given ? values(scene.gravity->participation, n, 0.0) : rotor.x.mass;
  rotor.gravity_y = given ? rotor.gravity_x : rotor.y.mass;

  rotor.spin_inertia = modal.inertia;
  rotor.torsion = modal_form_torsion(scene);
  return rotor;
}

ModalRotor geometry_form(const scene::Scene& scene) {
  ModalRotor rotor = reduce_bending(scene, rotor_modes(scene));
  rotor.spin_inertia = spin_inertia(scene);
  rotor.torsion = torsion_modes(scene);
  return rotor;
}

// Calls add(z, J) for every polar inertia J (kg m^2) along the shaft: quadrature points of the
// shaft itself, discs and motor.
template <typename Add>
void for_each_inertia(const scene::Scene& scene, const std::vector<ShaftElement>& mesh,
                      const Add& add) {
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  for (const ShaftElement& element : mesh) {
    for_each_point(element, element.functions + 1, [&](double z, double, double weight) {
      add(z, geometry.rho * 2.0 * element.inertia(z) * 0.5 * element.length() * weight);
    });
  }
  for (const scene::Disc& disc : geometry.discs) add(disc.z, disc.Jp);
  if (scene.drive) add(scene.drive->station, scene.drive->inertia);
}

struct TorsionSolution {
  TorsionBasis basis;
  PlanarModes modes;
  int wanted;
  // rad/s, highest requested frequency (see solve_refined)
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

  // Free shaft: the offset removes the share of the rigid spin. The elastic part then has no
  // angular momentum, so the two are orthogonal. A shaft held at z = 0 needs no offset.
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

ModalRotor modal_rotor(const scene::Scene& scene) {
  assert(scene.rotor.geometry.has_value() != scene.rotor.modal.has_value());
  if (scene.rotor.assembled) return *scene.rotor.assembled;
  return with_place(
      scene, [&] { return scene.rotor.geometry ? geometry_form(scene) : modal_form(scene); });
}

double spin_inertia(const scene::Scene& scene) {
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  double inertia = scene.drive ? scene.drive->inertia : 0.0;
  for (const scene::ShaftSection& section : geometry.sections) {
    // The mean of d^4 over the length of a cone is (a^4 + a^3 b + a^2 b^2 + a b^3 + b^4) / 5.
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

  const std::optional<double> contact = contact_station(scene);
  const std::vector<double> stations = line_stations(solution.basis.mesh());
  const Eigen::Index n = wanted;
  TorsionModes result{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n),
                      Eigen::VectorXd(n),
                      std::vector<Eigen::VectorXd>(scene.auxiliary.size(), Eigen::VectorXd(n))};
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::VectorXd mode = solution.modes.shape.col(j);  // scaled to unit inertia
    const auto angle = [&](double z) { return solution.basis.angle(z).dot(mode); };
    const ModeScale scale = mode_scale(angle, stations, contact);
    const double omega = solution.modes.frequency[j];
    result.inertia[j] = scale.factor * scale.factor;
    result.stiffness[j] = result.inertia[j] * omega * omega;
    result.damping[j] = 2.0 * scene.rotor.torsion->damping_ratio * result.inertia[j] * omega;
    // Without a drive the shaft is held at the motor's station, so the motor does not move.
    result.drive_shape[j] = scene.drive ? scale.factor * angle(scene.drive->station) : 0.0;
    result.contacts.front()[j] = scale.contact;
    for (std::size_t k = 1; k < scene.auxiliary.size(); ++k) {
      result.contacts[k][j] = scale.factor * angle(scene.auxiliary[k].contact->station);
    }
  }
  return result;
}

}  // namespace rotorub
