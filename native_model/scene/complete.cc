#include <algorithm>

#include "native_model/scene/disc.h"
#include "native_model/scene/reading.h"
#include "native_model/scene/shaft_bearing.h"

namespace rotorub::scene {
namespace {

constexpr double kSteelPoisson = 0.3;  // used if nothing gives nu or G

void fill(std::vector<double>& list, const std::vector<double>& standard) {
  if (list.empty()) list = standard;
}

}  // namespace

void complete(Scene& scene) {
  const Record& record = *scene.record;
  std::sort(scene.run.output_times.begin(), scene.run.output_times.end());
  // MuJoCo's rigid law does not support compliant contacts.
  if (scene.is_compliant() && !record.given("mujoco.contact")) {
    scene.mujoco.contact = ContactModel::kCoulomb;
  }
  Rotor& rotor = scene.rotor;
  if (rotor.geometry && !record.given("rotor.G")) {
    const double nu = rotor.geometry->nu.value_or(kSteelPoisson);
    rotor.geometry->G = rotor.geometry->E / (2.0 * (1.0 + nu));
  }
  if (rotor.geometry) complete_discs(rotor);
  if (rotor.geometry) complete_bearings(rotor);
  if (rotor.torsion && rotor.geometry && !record.given("rotor.torsion.damping_ratio")) {
    rotor.torsion->damping_ratio = rotor.geometry->damping_ratio;
  }
  if (!rotor.modal) return;

  RotorModal& modal = *rotor.modal;
  const std::vector<double> zeros(modal.mass.size(), 0.0), ones(modal.mass.size(), 1.0);
  fill(modal.damping, zeros);
  fill(modal.internal_damping, zeros);
  fill(modal.gyroscopic, zeros);
  fill(modal.mass_y, modal.mass);
  fill(modal.stiffness_y, modal.stiffness);
  fill(modal.damping_y, modal.damping);
  for (Force& force : scene.forces) fill(force.shape, ones);
  for (MagneticBearing& bearing : scene.magnetic_bearings) fill(bearing.shape, ones);
  if (rotor.torsion) {
    const std::vector<double> no_torsion(rotor.torsion->inertia.size(), 0.0);
    fill(rotor.torsion->damping, no_torsion);
    fill(rotor.torsion->drive_shape, no_torsion);
  }
}

}  // namespace rotorub::scene
