#include "compare/run_files/doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compare/modes/levitation_text.h"
#include "native_model/linear/levitation.h"
#include "native_model/model/model.h"
#include "native_model/scene/record.h"
#include "native_model/scene/text.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {
namespace {

// Reports a law that does not act during the run.
void doubt_control(const scene::Controller& law, double end, const std::string& where,
                   std::vector<std::string>& all) {
  if (law.kind == scene::ControllerKind::kPassive) return;
  if (law.on >= end) {
    all.push_back(
        fmt::format("{}controller.on = {:.6g} s: the run ends at {:.6g} s, and the law "
                    "never acts",
                    where, law.on, end));
  } else if (law.sample_time >= end) {
    all.push_back(
        fmt::format("{}controller.sample_time = {:.6g} s: the run ends at {:.6g} s, and "
                    "the law acts once at most",
                    where, law.sample_time, end));
  }
}

// Reports an instant far beyond the end, probably meant in milliseconds.
void doubt_instants(const scene::Scene& scene, std::vector<std::string>& all) {
  const double end = scene.run.end;
  const auto look_at = [&](const std::string& key, double instant, const char* what) {
    if (instant < kLateInstant * end || instant >= scene::kNever) return;
    all.push_back(
        fmt::format("{} = {:.6g} s: the run ends at {:.6g} s, and {} (a number without "
                    "a unit is in seconds: \"20 ms\")",
                    key, instant, end, what));
  };
  for (std::size_t i = 0; i < scene.forces.size(); ++i) {
    const std::string force = fmt::format("force[{}].", i);
    look_at(force + "on", scene.forces[i].on, "the force never acts");
    look_at(force + "off", scene.forces[i].off, "the force acts to the end");
  }
  for (std::size_t i = 0; i < scene.magnetic_bearings.size(); ++i) {
    const auto& control = scene.magnetic_bearings[i].control;
    if (!control) continue;
    const std::string bearing = scene::magnetic_bearing_path(scene, i) + ".control.";
    look_at(bearing + "on", control->works_from, "the bearing never works");
    look_at(bearing + "fails_at", control->fails_at, "the bearing does not fail");
    look_at(bearing + "returns_at", control->returns_at, "the bearing does not return");
  }
}

void doubt_tables(const scene::RotorGeometry& shaft, double speed, std::vector<std::string>& all) {
  for (std::size_t i = 0; i < shaft.bearings.size(); ++i) {
    const std::vector<double>& table = shaft.bearings[i].table_speed;
    if (table.empty() || (speed >= table.front() && speed <= table.back())) continue;
    all.push_back(fmt::format(
        "rotor.bearing[{}].table_speed runs from {:.6g} to {:.6g} rad/s, and the rotor turns at "
        "{:.6g} rad/s: the nearer end of the table holds there (a number without a unit is in "
        "rad/s: \"4000 rpm\")",
        i, table.front(), table.back(), speed));
  }
}

// Share of the rows from the first with a force of the actuator on in which an axis is at its
// limit.
double saturated_share(const Trajectory& run, std::size_t contact, double limit) {
  constexpr double kAtLimit = 0.999;
  const auto &x = run.column(column_of_contact(contact, "control_x")),
             &y = run.column(column_of_contact(contact, "control_y"));
  std::size_t rows = 0, saturated = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (rows == 0 && x[i] == 0.0 && y[i] == 0.0) continue;
    ++rows;
    const double on_an_axis = (std::abs(x[i]) + std::abs(y[i])) / std::numbers::sqrt2;
    if (on_an_axis >= kAtLimit * limit) ++saturated;
  }
  return rows == 0 ? 0.0 : static_cast<double>(saturated) / static_cast<double>(rows);
}

void doubt_saturation(const scene::Scene& scene, const Trajectory& run,
                      std::vector<std::string>& all) {
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const auto& actuator = scene.auxiliary[k].actuator;
    if (!actuator || actuator->kind != scene::ActuatorKind::kIdeal) continue;
    if (!std::isfinite(actuator->force_limit) || !run.has(column_of_contact(k, "control_x")))
      continue;
    const double share = saturated_share(run, k, actuator->force_limit);
    if (share <= kMostSaturation) continue;
    all.push_back(fmt::format(
        "{}the actuator is at its limit of {:.4g} N (actuator.force_limit) for {:.0f} % of the "
        "time since switch-on",
        scene.auxiliary.size() > 1 ? fmt::format("{}: ", scene.name_of(k)) : std::string(),
        actuator->force_limit, 100.0 * share));
  }
}

// Reports magnetic bearings whose loop is unstable if the run shows it: it failed, or its motion
// grew without a contact.
void doubt_levitation(const scene::Scene& scene, const Trajectory& run,
                      std::vector<std::string>& all) {
  const bool failed = run.status == Status::kOutOfRange || run.status == Status::kNoSolution ||
                      run.status == Status::kDiverged || run.status == Status::kStepTooLarge;
  const bool free = run.status == Status::kOk && run.statistics.first_touch < 0.0;
  if (scene.magnetic_bearings.empty() || !(failed || free)) return;
  if (scene.magnetic_control && scene.magnetic_control->by_library()) return;  // it has no poles
  scene::Scene bearings = scene;  // neither the laws of the rings nor the start matter
  for (scene::AuxiliaryBearing& at : bearings.auxiliary) at.controller.reset();
  const Model model = make_model(bearings, [](Model&) {});
  const Levitation loop = levitation_poles(model, scene.rotor.speed);
  if (!loop.unstable()) return;
  if (free && loop.poles.front().real() * run.end < 1.0) return;
  all.push_back(instability_text(scene.rotor.speed, loop) +
                " Change its gains until `rotorub modes` calls the loop stable.");
}

// Reports lengths that do not fit the shaft, probably given in millimetres without a unit.
void doubt_lengths(const scene::Scene& scene, std::vector<std::string>& all) {
  const scene::RotorGeometry& shaft = *scene.rotor.geometry;
  const auto look_at = [&](const std::string& key, double length, double most) {
    if (length <= most * shaft.length) return;
    all.push_back(fmt::format(
        "{} = {:.4g} m is larger than {}rotor.length = {:.4g} m (a unit may be "
        "missing: \"{:.4g} mm\")",
        key, length, most > 1.0 ? fmt::format("{:g} times ", most) : "", shaft.length, length));
  };
  double thickest = 0.0;  // m
  for (const auto& section : shaft.sections) thickest = std::max(thickest, section.diameter);
  if (shaft.length > kLongShaft && shaft.length > kMostSlender * thickest) {
    all.push_back(fmt::format(
        "rotor.length = {0:.4g} m is unusually long (a unit may be missing: \"{0:.4g} mm\")",
        shaft.length));
  }
  for (std::size_t i = 0; i < shaft.sections.size(); ++i) {
    const std::string section = scene::list_element("rotor.section", i);
    look_at(section + ".diameter", shaft.sections[i].diameter, 1.0);
    look_at(section + ".end_diameter", shaft.sections[i].end_diameter.value_or(0.0), 1.0);
  }
  for (std::size_t i = 0; i < shaft.discs.size(); ++i) {
    const std::string disc = scene::list_element("rotor.disc", i);
    look_at(disc + ".diameter", shaft.discs[i].diameter.value_or(0.0), kWidestDisc);
    look_at(disc + ".thickness", shaft.discs[i].thickness.value_or(0.0), 1.0);
  }
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    if (!scene.auxiliary[k].contact) continue;
    const bool several = scene.auxiliary.size() > 1;
    look_at((several ? scene.name_of(k) + ": " : "") + "contact.radius",
            scene.auxiliary[k].contact->radius, kWidestDisc);
  }
}

}  // namespace

std::vector<std::string> doubts(const scene::Scene& scene) {
  std::vector<std::string> all;
  const double speed = std::abs(scene.rotor.speed);
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const auto& contact = scene.auxiliary[k].contact;
    const std::string where =
        scene.auxiliary.size() > 1 ? fmt::format("{}: ", scene.name_of(k)) : std::string();
    if (const auto& law = scene.auxiliary[k].controller)
      doubt_control(*law, scene.run.end, where, all);
    if (!contact) continue;
    if (contact->clearance > kMostClearance * contact->radius) {
      all.push_back(fmt::format(
          "{}contact.clearance = {:.4g} m is {:.3g} times the rotor's radius there; clearances are "
          "some thousandths of it (a unit may be missing: \"0.5 mm\")",
          where, contact->clearance, contact->clearance / contact->radius));
    }
    if (speed * contact->radius > kFastestSurface) {
      all.push_back(fmt::format(
          "{}rotor.speed = {:.6g} rad/s moves the surface at the contact at {:.4g} m/s (a number "
          "without a unit is in rad/s: \"3000 rpm\", \"50 Hz\")",
          where, scene.rotor.speed, speed * contact->radius));
    }
    if (contact->friction.sticking() > kMostFriction) {
      all.push_back(fmt::format("{}contact.friction = {:.4g}; dry metal has 0.1 to 0.8", where,
                                contact->friction.sticking()));
    }
  }
  doubt_instants(scene, all);
  if (!scene.rotor.geometry) return all;
  doubt_lengths(scene, all);
  if (speed > 0.0) doubt_tables(*scene.rotor.geometry, scene.rotor.speed, all);
  if (scene.rotor.geometry->E < kSoftestShaft) {
    all.push_back(fmt::format("rotor.E = {:.4g} Pa is softer than any metal (steel: \"210 GPa\")",
                              scene.rotor.geometry->E));
  }
  for (const scene::Disc& disc : scene.rotor.geometry->discs) {
    if (disc.eccentricity <= kMostEccentricity) continue;
    all.push_back(
        fmt::format("rotor.disc.eccentricity = {0:.4g} m at z = {1:.4g} m; balanced discs have "
                    "some micrometres "
                    "(a unit may be missing: \"{0:.4g} µm\")",
                    disc.eccentricity, disc.z));
  }
  return all;
}

std::vector<std::string> doubts(const scene::Scene& scene, const Trajectory& run) {
  std::vector<std::string> all = doubts(scene);
  const double off = run.statistics.energy_residual();
  if (run.engine == "native" && run.status == Status::kOk && off > kMostEnergyError) {
    all.push_back(fmt::format(
        "energy balance: the work done and the change of energy differ by {:.2g} % of the largest "
        "energy. The step of {:.3g} s is too long for this motion: halve run.step until this "
        "warning disappears, or use run.integrator = \"event\"",
        100.0 * off, run.step));
  }
  doubt_saturation(scene, run, all);
  doubt_levitation(scene, run, all);
  return all;
}

}  // namespace rotorub
