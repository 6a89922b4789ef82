#include "compare/report/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/base/json.h"
#include "compare/base/plot_points.h"
#include "compare/base/units.h"
#include "compare/report/measured_side.h"
#include "compare/report/pack/packed_run.h"
#include "compare/report/run_data.h"
#include "compare/report/whirl_plots.h"
#include "native_model/bearing/drive.h"
#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "renders/playback.h"

namespace rotorub {

ShownRuns shown_runs(const SceneComparison& comparison) {
  ShownRuns shown{&comparison.scene, {}, nullptr, nullptr};
  for (const Side* side : comparison.sides())
    shown.runs.push_back({side->label, &side->trajectory});
  if (comparison.measured) shown.measured = &*comparison.measured;
  if (comparison.uncontrolled) shown.uncontrolled = &*comparison.uncontrolled;
  return shown;
}

ShownRuns shown_runs(const StoredRun& run, const std::optional<StoredRun>& shadow) {
  const Trajectory& t = run.trajectory;
  ShownRuns shown{
      &run.scene, {{t.engine == "mujoco" ? t.contact_model : "native", &t}}, nullptr, nullptr};
  if (shadow) shown.runs.push_back({"shadow", &shadow->trajectory});
  return shown;
}

namespace {

using nlohmann::json;
using Values = std::vector<double>;

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

// The motor's characteristic around the speeds of the first run.
json motor_data(const scene::Scene& scene, const Trajectory& run) {
  const Values& speed = run.column("spin_speed");
  if (speed.empty()) return nullptr;
  const auto [slowest, fastest] = std::minmax_element(speed.begin(), speed.end());
  const double room = std::max(0.02 * std::abs(*fastest), 0.2 * (*fastest - *slowest));
  return motor_curve(scene, *slowest - room, *fastest + room);
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

json plot_data(const ShownRuns& shown) {
  const scene::Scene& scene = *shown.scene;
  const std::optional<renders::Machine> machine = drawn_machine(shown);
  json sides = json::array();
  double limit = 0.0;  // Hz, for all spectra
  for (const ShownRun& run : shown.runs) limit = std::max(limit, spectrum_reach(*run.trajectory));
  for (const ShownRun& run : shown.runs) {
    const Trajectory* first = shown.runs.front().trajectory;
    json& side = sides.emplace_back(run_data(scene, run.label, *run.trajectory,
                                             run.trajectory == first ? nullptr : first,
                                             machine ? &*machine : nullptr, limit));
    side["first_touch"] = number_or_null(renders::first_touch(*run.trajectory));
    json force = sampled_force(shown, run.label);
    if (!force.is_null()) side["tracks"]["force"] = std::move(force);
  }
  if (shown.measured && machine) sides.push_back(measured_side(shown, limit));
  json uncontrolled = nullptr;
  if (shown.uncontrolled && shown.uncontrolled->rows() > 0 && machine) {
    uncontrolled = {
        {"rotor", track_json(pack_run(scene, *machine, *shown.uncontrolled).at("rotor"))}};
  }
  const Trajectory* first = shown.runs.empty() ? nullptr : shown.runs.front().trajectory;
  return {{"name", scene.name},
          {"motor", first ? motor_data(scene, *first) : json()},
          {"spin", first ? mean_spin(*first) : 0.0},
          {"uncontrolled", uncontrolled},
          {"speed", scene.rotor.speed},
          {"rig", machine ? rig_values(scene, *machine) : json()},
          {"contacts", contacts_values(scene, machine)},
          {"sides", sides}};
}

}  // namespace rotorub
