#include "native_model/rotor/modal_rotor.h"

#include <cassert>

#include "native_model/rotor/modal_reduction.h"
#include "native_model/rotor/refusal.h"
#include "native_model/rotor/rotor_modes.h"
#include "native_model/rotor/torsion.h"

namespace rotorub {
namespace {

// A list of the scene as a vector of n; an empty list means `missing` throughout.
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

// Modal form: what the scene states, copied.
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
  if (scene.magnetic_bearing) rotor.magnetic_bearing_shape = shape(scene.magnetic_bearing->shape);

  // Without a participation a mode weighs what it is.
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

}  // namespace

ModalRotor modal_rotor(const scene::Scene& scene) {
  assert(scene.rotor.geometry.has_value() != scene.rotor.modal.has_value());
  if (scene.rotor.assembled) return *scene.rotor.assembled;
  return with_place(
      scene, [&] { return scene.rotor.geometry ? geometry_form(scene) : modal_form(scene); });
}

}  // namespace rotorub
