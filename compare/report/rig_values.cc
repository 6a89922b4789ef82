#include "compare/report/rig_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "compare/base/units.h"
#include "compare/report/pack/packed_run.h"
#include "compare/report/plot_points.h"
#include "native_model/bearing/drive.h"
#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"

namespace rotorub {

namespace {

using nlohmann::json;

// One array per mode.
json shapes(const Eigen::MatrixXd& modes) {
  return list_of(modes.colwise(), [](const auto& mode) { return json(mode); });
}

// A bearing that consists only of a force is not drawn.
json magnet_values(const renders::Machine& machine) {
  return list_of(machine.magnetic_bearings, [](const renders::DrawnMagneticBearing& magnet) {
    return json{{"z", magnet.z},
                {"bore", magnet.bore},
                {"outer", magnet.outer},
                {"half_width", magnet.half_width}};
  });
}

// m: distance from the middle that the actuators' curves cover.
double shown_travel(const scene::Actuator& a) {
  if (a.kind == scene::ActuatorKind::kTable)
    return std::min(-a.table_position.front(), a.table_position.back());
  return 0.4 * a.air_gap;
}

template <class Law>
json curve(double from, double to, Law law) {
  constexpr int kPoints = 61;
  json x = json::array(), y = json::array();
  for (int k = 0; k < kPoints; ++k) {
    const double at = from + (to - from) * k / (kPoints - 1);
    x.push_back(at);
    y.push_back(law(at));
  }
  return {{"x", x}, {"y", y}};
}

}  // namespace

std::optional<renders::Machine> drawn_machine(const ShownRuns& shown) {
  for (const ShownRun& run : shown.runs) {
    if (run.trajectory->rows() == 0) continue;
    const renders::Playback playback(*run.trajectory);
    const std::array<const renders::Playback*, 1> runs = {&playback};
    return renders::make_machine(*shown.scene, runs, playback.start(), playback.end(),
                                 std::nullopt);
  }
  return std::nullopt;
}

json rig_values(const scene::Scene& scene, const renders::Machine& machine) {
  return {
      {"unit", machine.unit},
      {"magnification", machine.magnification},
      {"has_shape", scene.rotor.geometry.has_value()},
      {"z", machine.z},
      {"span_radius", machine.span_radius},
      {"modes_x", shapes(machine.modes_x)},
      {"modes_y", shapes(machine.modes_y)},
      {"bow", machine.bow},
      {"discs",
       list_of(machine.discs,
               [](const renders::DrawnDisc& disc) -> json {
                 return {{"z", disc.z}, {"radius", disc.radius}, {"half_width", disc.half_width}};
               })},
      {"bearings", scene.rotor.geometry ? json(machine.bearings) : json::array()},
      {"magnetic_bearings", magnet_values(machine)},
      {"motor",
       scene.drive && scene.rotor.geometry && machine.motor ? json(*machine.motor) : json()}};
}

json contacts_values(const scene::Scene& scene, const std::optional<renders::Machine>& machine) {
  constexpr double kHalfWidth = 0.4;  // relative to the radius
  const std::size_t count = scene.auxiliary.size();
  json all = json::array();
  for (std::size_t k = 0; k < count; ++k) {
    const scene::AuxiliaryBearing& bearing = scene.auxiliary[k];
    const scene::Contact contact = bearing.contact.value_or(scene::Contact());
    const double unit = machine ? machine->unit : 1.0;
    // A rotor in modal form has no stations, so its contacts are spaced evenly along the drawn
    // shaft.
    const double z = scene.rotor.geometry
                         ? contact.station * unit
                         : static_cast<double>(k + 1) / static_cast<double>(count + 1);
    all.push_back({{"name", count > 1 ? scene.name_of(k) : ""},
                   {"touches", bearing.contact.has_value()},
                   {"rubs", bearing.contact && !contact.friction.is_frictionless()},
                   {"clearance", contact.clearance},
                   {"restitution", contact.restitution},
                   {"friction", contact.friction.sticking()},
                   {"radius", contact.radius},
                   {"gap_tolerance", gap_tolerance(contact.clearance)},
                   {"section_magnification",
                    renders::section_magnification(with_bearing_alone(scene, k), 0.0)},
                   {"z", z},
                   {"drawn_radius", contact.radius * unit},
                   {"half_width", kHalfWidth * contact.radius * unit},
                   {"ring_moves", bearing.stator.has_value()},
                   {"ring_turns", bearing.stator && bearing.stator->spin},
                   {"actuators", bearing.stator && bearing.actuator},
                   {"actuator", actuator_curves(scene, k)}});
  }
  return all;
}

json actuator_curves(const scene::Scene& scene, std::size_t bearing) {
  json curves = json::array();
  const Model model = prepare(scene);
  const auto& magnets = model.auxiliary[bearing].magnets;
  if (!magnets) return curves;
  const double travel = shown_travel(*scene.auxiliary[bearing].actuator);
  const double most = magnets->current_limit;
  for (const double part : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    curves.push_back(
        curve(-most, most, [&](double i) { return magnets->law->force(part * travel, i); }));
    curves.back()["name"] = fmt::format("s = {:.3g} mm", kMilli * part * travel);
  }
  return curves;
}

json motor_curve(const scene::Scene& scene, double from, double to) {
  if (!scene.drive) return nullptr;
  const Drive drive(*scene.drive, scene.rotor.speed);
  if (drive.follows() || drive.kind() == scene::DriveKind::kFree) return nullptr;
  return curve(kRpm * from, kRpm * to, [&](double rpm) { return drive.torque(rpm / kRpm); });
}

}  // namespace rotorub
