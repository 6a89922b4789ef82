#include "compare/report/rig_values.h"

#include <array>
#include <nlohmann/json.hpp>

#include "compare/report/pack/packed_run.h"
#include "compare/report/rounded.h"
#include "native_model/rotor/modal_rotor.h"

namespace rotorub {
namespace {

using nlohmann::json;

template <class Values>
json numbers(const Values& values) {
  json out = json::array();
  for (const double value : values) out.push_back(rounded(value, kDigits));
  return out;
}

// One array a mode.
json shapes(const Eigen::MatrixXd& modes) {
  json out = json::array();
  for (Eigen::Index k = 0; k < modes.cols(); ++k) out.push_back(numbers(modes.col(k)));
  return out;
}

json disc_values(const renders::Machine& machine) {
  json out = json::array();
  for (const renders::DrawnDisc& disc : machine.discs) {
    out.push_back({{"z", disc.z}, {"radius", disc.radius}, {"half_width", disc.half_width}});
  }
  return out;
}

json contact_values(const renders::Machine& machine) {
  if (!machine.contact) return nullptr;
  return {{"z", machine.contact->z},
          {"radius", machine.contact->rotor_radius},
          {"half_width", machine.contact->half_width}};
}

// Nothing stands for a bearing that a force alone implies.
json magnet_values(const scene::Scene& scene, const renders::Machine& machine) {
  if (!scene.magnetic_bearing || !machine.magnetic_bearing) return nullptr;
  const renders::DrawnMagneticBearing& magnet = *machine.magnetic_bearing;
  return {{"z", magnet.z},
          {"bore", magnet.bore},
          {"outer", magnet.outer},
          {"half_width", magnet.half_width}};
}

}  // namespace

std::optional<renders::Machine> drawn_machine(const ShownRuns& shown) {
  for (const ShownRun& run : shown.runs) {
    if (run.trajectory->rows() == 0) continue;
    const scene::Scene& scene = *shown.scene;
    std::optional<ModeLines> lines;
    if (scene.rotor.geometry) lines = modal_rotor(scene).lines;
    const renders::Playback playback(*run.trajectory);
    const std::array<const renders::Playback*, 1> runs = {&playback};
    return renders::make_machine(scene, lines, runs, playback.start(), playback.end(),
                                 std::nullopt);
  }
  return std::nullopt;
}

json rig_values(const scene::Scene& scene, const renders::Machine& machine) {
  return {{"unit", machine.unit},
          {"magnification", machine.magnification},
          {"section_magnification", renders::section_magnification(scene, 0.0)},
          {"clearance", machine.clearance},
          {"gap_tolerance", gap_tolerance(machine.clearance)},
          {"radius", scene.first().contact ? scene.first().contact->radius : 0.0},
          {"friction", scene.first().contact ? scene.first().contact->friction.sticking() : 0.0},
          {"has_shape", scene.rotor.geometry.has_value()},
          {"z", numbers(machine.z)},
          {"span_radius", numbers(machine.span_radius)},
          {"modes_x", shapes(machine.modes_x)},
          {"modes_y", shapes(machine.modes_y)},
          {"bow", numbers(machine.bow)},
          {"discs", disc_values(machine)},
          {"bearings", scene.rotor.geometry ? json(machine.bearings) : json::array()},
          {"contact", contact_values(machine)},
          {"magnetic_bearing", magnet_values(scene, machine)},
          {"motor",
           scene.drive && scene.rotor.geometry && machine.motor ? json(*machine.motor) : json()},
          {"ring_moves", !machine.support.fixed},
          {"ring_turns", machine.ring_turns},
          {"actuators", scene.first().stator.has_value() && scene.first().actuator.has_value()}};
}

}  // namespace rotorub
