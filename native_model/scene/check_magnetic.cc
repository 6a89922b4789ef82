// Cross-checks of [magnetic_bearing]: what it alone holds it must hold.

#include <algorithm>

#include "native_model/scene/checker.h"
#include "native_model/scene/shaft_bearing.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

// The bearings leave the shaft no rigid motion in this plane: they hold it at two stations.
bool held_by_bearings(const RotorGeometry& shaft, double speed, int plane) {
  double first = 0.0;
  bool any = false;
  for (const ShaftBearing& bearing : shaft.bearings) {
    if (!(stiffness_at(bearing, speed)[plane] > 0.0)) continue;
    if (any && bearing.z != first) return true;
    first = bearing.z;
    any = true;
  }
  return false;
}

// What nothing but the magnetic bearing holds; empty: nothing.
std::string held_by_magnets(const Scene& scene, const MagneticBearing& magnetic) {
  const char* planes[] = {"x", "y"};
  if (scene.rotor.geometry) {
    for (int plane : {0, 1}) {
      if (held_by_bearings(*scene.rotor.geometry, scene.rotor.speed, plane)) continue;
      return std::string("the shaft against rigid motion in plane ") + planes[plane];
    }
  }
  if (!scene.rotor.modal) return {};
  const RotorModal& modal = *scene.rotor.modal;
  for (std::size_t k = 0; k < modal.stiffness.size(); ++k) {
    const bool touched =
        magnetic.shape.empty() || (k < magnetic.shape.size() && magnetic.shape[k] != 0.0);
    const bool free_y = k < modal.stiffness_y.size() && modal.stiffness_y[k] == 0.0;
    if (!touched || !(modal.stiffness[k] == 0.0 || free_y)) continue;
    return "mode " + std::to_string(k + 1) + ", whose stiffness is 0, in plane " +
           planes[modal.stiffness[k] == 0.0 ? 0 : 1];
  }
  return {};
}

}  // namespace

void check_magnetic_bearing(const Checker& check) {
  const auto& magnetic = check.scene.magnetic_bearing;
  if (!magnetic) return;
  check.station("magnetic_bearing.station", magnetic->station);
  if (const auto modes = check.bending_modes()) {
    check.list_length("magnetic_bearing.shape", magnetic->shape, *modes, "bending mode");
  }
  if (!magnetic->control || !check.sound({"magnetic_bearing.negative_stiffness",
                                          "magnetic_bearing.control.force_per_current",
                                          "magnetic_bearing.control.proportional"})) {
    return;
  }
  const BearingControl& control = *magnetic->control;
  if (control.integral > 0.0 && control.proportional == 0.0) {
    check.fail("magnetic_bearing.control.integral",
               "needs magnetic_bearing.control.proportional, whose force the integrator replaces "
               "within P / I");
  }
  const double magnets = control.force_per_current * control.proportional;
  const double against = magnetic->negative_stiffness;
  if (magnets > against) return;
  const std::string held = held_by_magnets(check.scene, *magnetic);
  if (held.empty()) return;
  check.fail("magnetic_bearing.control.proportional",
             "times force_per_current is " + number_text(magnets) +
                 " N/m, and negative_stiffness takes " + number_text(against) +
                 " N/m of it: " + number_text(against - magnets) + " N/m too little to hold " +
                 held + ", which nothing else holds; accepted: more than " +
                 number_text(against / control.force_per_current) + " A/m");
}

}  // namespace rotorub::scene
