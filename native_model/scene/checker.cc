#include "native_model/scene/checker.h"

#include <algorithm>
#include <functional>

#include "native_model/scene/disc.h"
#include "native_model/scene/shaft_bearing.h"

namespace rotorub::scene {

namespace {

constexpr double kSteelPoisson = 0.3;  // used if nothing gives nu or G

void fill(std::vector<double>& list, const std::vector<double>& standard) {
  if (list.empty()) list = standard;
}

}  // namespace

void Checker::station(const std::string& path, double z) const {
  if (!scene.rotor.geometry || !sound({path, "rotor.length"})) return;
  const double length = scene.rotor.geometry->length;
  if (z > length) {
    fail(path, "out of the shaft: must be in [0, rotor.length = " + std::to_string(length) +
                   " m], got " + std::to_string(z) + " m");
  }
}

void Checker::list_length(const std::string& path, const std::vector<double>& list,
                          std::size_t length, const std::string& of) const {
  if (!given(path) || !sound({path}) || list.size() == length) return;
  fail(path, "expected " + std::to_string(length) + " value(s), one for each " + of + ", got " +
                 std::to_string(list.size()));
}

void Checker::ascending(const std::string& path, const std::vector<double>& list) const {
  if (std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) != list.end())
    fail(path, "must be strictly ascending");
}

std::optional<std::size_t> Checker::bending_modes() const {
  if (scene.rotor.modal && given("rotor.modal.mass") && sound({"rotor.modal.mass"})) {
    return scene.rotor.modal->mass.size();
  }
  if (scene.rotor.geometry && scene.rotor.geometry->modes && sound({"rotor.modes"})) {
    return static_cast<std::size_t>(*scene.rotor.geometry->modes);
  }
  return std::nullopt;
}

std::optional<std::size_t> Checker::torsion_modes() const {
  if (!scene.rotor.torsion) return std::nullopt;
  const Torsion& torsion = *scene.rotor.torsion;
  if (given("rotor.torsion.inertia") && sound({"rotor.torsion.inertia"})) {
    return torsion.inertia.size();
  }
  if (torsion.modes > 0) return static_cast<std::size_t>(torsion.modes);
  return std::nullopt;
}

void validate(const Scene& scene, const Record& record, std::vector<Diagnostic>& diagnostics) {
  const Checker check{scene, record, diagnostics};
  check_rotor(check);
  check_run(check);
  check_loads(check);
  check_start(check);
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const Checker of_bearing{scene, record, diagnostics, k};
    check_ring(of_bearing);
    check_actuator(of_bearing);
    check_contact(of_bearing);
    check_control(of_bearing);
  }
}

Scene with_bearing_alone(const Scene& scene, std::size_t bearing) {
  Scene alone = scene;
  alone.auxiliary = {scene.auxiliary[bearing]};
  alone.first().name = scene.name_of(bearing);
  alone.first_index = bearing;
  return alone;
}

std::optional<double> smallest_clearance(const Scene& scene) {
  std::optional<double> smallest;
  for (const AuxiliaryBearing& at : scene.auxiliary) {
    if (!at.contact) continue;
    if (!smallest || at.contact->clearance < *smallest) smallest = at.contact->clearance;
  }
  return smallest;
}

void complete(Scene& scene, const Record& record) {
  std::sort(scene.run.output_times.begin(), scene.run.output_times.end());
  // MuJoCo's rigid law does not support compliant contacts.
  if (scene.gives() && !record.given("mujoco.contact")) {
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
