#include "renders/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "native_model/prepare/prepare.h"
#include "native_model/rotor/modal_rotor.h"

namespace rotorub::renders {

namespace {

constexpr int kSpans = 48;  // of the drawn shaft
// Fractions of the rotor's radius: a clearly visible clearance, and the smallest visible one.
constexpr double kClearanceShare = 0.45;
constexpr double kLeastShare = 0.15;
constexpr double kRingMotionShare = 0.9;   // of the rotor's radius, in the cross-section
constexpr double kMotionShare = 0.1;       // of the shaft's length, in the machine view
constexpr double kWidestClearance = 0.06;  // of the shaft's length, in the machine view

// Values at stations `to`, interpolated from ascending stations `from`, with one column per mode.
Eigen::MatrixXd resample(const Eigen::VectorXd& from, const Eigen::MatrixXd& values,
                         const Eigen::VectorXd& to) {
  Eigen::MatrixXd result(to.size(), values.cols());
  for (Eigen::Index i = 0; i < to.size(); ++i) {
    const auto after = std::upper_bound(from.begin(), from.end(), to[i]);
    const Eigen::Index next = std::clamp<Eigen::Index>(after - from.begin(), 1, from.size() - 1);
    const double s = std::clamp((to[i] - from[next - 1]) / (from[next] - from[next - 1]), 0.0, 1.0);
    result.row(i) = (1.0 - s) * values.row(next - 1) + s * values.row(next);
  }
  return result;
}

// Evenly spaced stations and all changes of diameter, m.
Eigen::VectorXd shaft_stations(const scene::RotorGeometry& geometry) {
  std::vector<double> stations;
  for (int i = 0; i <= kSpans; ++i) stations.push_back(geometry.length * i / kSpans);
  for (const scene::ShaftSection& section : geometry.sections) stations.push_back(section.from);
  std::sort(stations.begin(), stations.end());
  const double least = 1e-6 * geometry.length;
  const auto end = std::unique(stations.begin(), stations.end(),
                               [least](double a, double b) { return b - a < least; });
  return Eigen::VectorXd::Map(stations.data(), end - stations.begin());
}

double diameter_at(const scene::RotorGeometry& geometry, double z) {
  for (const scene::ShaftSection& section : geometry.sections) {
    if (z >= section.from && z <= section.to) return section.outer_at(z);
  }
  return 0.03 * geometry.length;
}

// A disc with given mass and inertia is drawn as the solid cylinder that has them:
// J_p = m R^2 / 2, m = rho pi R^2 (2 h).
DrawnDisc drawn_disc(const scene::Disc& disc, const scene::RotorGeometry& geometry, double unit) {
  const double shaft = 0.5 * diameter_at(geometry, disc.z) * unit;
  double radius = 0.08;
  double half_width = 0.015;
  if (disc.mass > 0.0 && disc.Jp > 0.0) {
    const double metres = std::sqrt(2.0 * disc.Jp / disc.mass);
    radius = metres * unit;
    half_width = 0.5 * disc.mass / (geometry.rho * std::numbers::pi * metres * metres) * unit;
  }
  return {disc.z * unit, std::clamp(radius, 1.3 * shaft, 0.2), std::clamp(half_width, 0.006, 0.06)};
}

void draw_geometry(Machine& machine, const scene::Scene& scene) {
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  machine.unit = 1.0 / geometry.length;
  const Eigen::VectorXd stations = shaft_stations(geometry);
  machine.z = stations * machine.unit;
  const ModeLines lines = *modal_rotor(scene).lines;
  machine.modes_x = resample(lines.z, lines.x, stations);
  machine.modes_y = resample(lines.z, lines.y, stations);
  double thickest = 0.0;
  for (Eigen::Index i = 0; i + 1 < stations.size(); ++i) {
    const double middle = 0.5 * (stations[i] + stations[i + 1]);
    machine.span_radius.push_back(0.5 * diameter_at(geometry, middle) * machine.unit);
    thickest = std::max(thickest, machine.span_radius.back());
  }
  for (const scene::Disc& disc : geometry.discs) {
    machine.discs.push_back(drawn_disc(disc, geometry, machine.unit));
  }
  for (const scene::ShaftBearing& bearing : geometry.bearings) {
    machine.bearings.push_back(bearing.z * machine.unit);
  }
  machine.bearing_bore = 1.05 * thickest;
  if (scene.drive) machine.motor = scene.drive->station * machine.unit;
}

// Modal data define no shape. The shaft is drawn with typical proportions, bent like a half wave if
// a spring holds it and straight otherwise.
void draw_modal(Machine& machine, const scene::Scene& scene) {
  machine.schematic = true;
  const double radius = scene.has_contact() ? scene.first().contact->radius : 0.05;
  machine.unit = 1.0 / (14.0 * radius);
  machine.z = Eigen::VectorXd::LinSpaced(kSpans + 1, 0.0, 1.0);
  machine.span_radius.assign(kSpans, 0.35 / 14.0);
  const scene::RotorModal& modal = *scene.rotor.modal;
  const bool held = std::any_of(modal.stiffness.begin(), modal.stiffness.end(),
                                [](double stiffness) { return stiffness > 0.0; });
  machine.bow = Eigen::VectorXd::Ones(machine.z.size());
  if (!held) return;
  constexpr double kEnd = 0.06;  // distance of the bearings from the ends
  machine.bow = ((machine.z.array() - kEnd) * std::numbers::pi / (1.0 - 2.0 * kEnd)).sin();
  machine.bearings = {kEnd, 1.0 - kEnd};
  machine.bearing_bore = 1.05 * machine.span_radius.front();
  if (scene.drive) machine.motor = 0.0;
}

// The largest size(centre line) at `looks` + 1 evenly spaced times of the film.
template <class Size>
double largest(const Machine& machine, std::span<const Playback* const> runs, double from,
               double to, int looks, Size size) {
  double most = 0.0;
  for (const Playback* run : runs) {
    for (int i = 0; i <= looks; ++i)
      most = std::max(most, size(machine.centre_line(run->at(from + (to - from) * i / looks))));
  }
  return most;
}

double machine_magnification(const scene::Scene& scene, double unit, double motion) {
  constexpr double kUnlimited = 1e300;
  const double by_motion = motion > 0.0 ? kMotionShare / motion : kUnlimited;
  // The contact that allows the least decides, so that every drawn ring stays small.
  double most = scene.has_contact() ? kUnlimited : by_motion;
  for (const scene::AuxiliaryBearing& bearing : scene.auxiliary) {
    if (!bearing.contact) continue;
    const double clearance = bearing.contact->clearance * unit;
    const double least = kLeastShare * bearing.contact->radius * unit / clearance;
    const double widest = std::max(least, kWidestClearance / clearance);
    most = std::min(most, std::clamp(by_motion, least, widest));
  }
  if (most > 1e200) return 1.0;
  return std::max(1.0, plain_number_below(most));
}

DrawnSupport drawn_support(const scene::AuxiliaryBearing& bearing) {
  DrawnSupport support;
  if (!bearing.stator) return support;
  support.fixed = false;
  support.spring_x = bearing.stator->stiffness[0] > 0.0;
  support.spring_y = bearing.stator->stiffness[1] > 0.0;
  const bool commanded =
      bearing.controller && bearing.controller->kind != scene::ControllerKind::kPassive;
  support.actuators = bearing.actuator.has_value() || commanded;
  support.magnets =
      bearing.actuator && bearing.actuator->kind == scene::ActuatorKind::kElectromagnet;
  return support;
}

// External forces; an eccentric mass is not one.
void draw_loads(Machine& machine, const scene::Scene& scene) {
  const Model model = prepare(scene);
  std::size_t next = 0;
  for (const scene::Force& force : scene.forces) {
    if (force.kind == scene::ForceKind::kUnbalance || next >= model.forces.size()) continue;
    const AppliedForce& applied = model.forces[next++];
    const double z = scene.rotor.geometry ? force.station * machine.unit : 0.5;
    machine.loads.push_back({z, applied});
    machine.largest_load =
        std::max({machine.largest_load, std::abs(applied.amplitude), applied.vector.norm()});
  }
}

// Draws the first contact. Further ones come from machines with that bearing alone.
void draw_contact(Machine& machine, const scene::Scene& scene) {
  const scene::AuxiliaryBearing& bearing = scene.first();
  const scene::Contact& contact = *bearing.contact;
  const double z = scene.rotor.geometry ? contact.station * machine.unit : 0.5;
  const double radius = contact.radius * machine.unit;
  const double clearance = machine.displaced(contact.clearance);
  machine.clearance = contact.clearance;
  machine.support = drawn_support(bearing);
  machine.ring_turns = bearing.stator && bearing.stator->spin;
  machine.contact = {z, radius, clearance, radius + clearance + 0.45 * radius, 0.4 * radius};
  // The rotor's body there represents a disc inside the ring, the sleeve.
  std::erase_if(machine.discs, [&](const DrawnDisc& disc) {
    return std::abs(disc.z - z) < machine.contact->half_width &&
           disc.radius < machine.contact->ring_outer;
  });
}

}  // namespace

double section_magnification(const scene::Scene& scene, double motion) {
  double least = std::numeric_limits<double>::infinity();  // of the contacts
  for (const scene::AuxiliaryBearing& bearing : scene.auxiliary) {
    if (!bearing.contact) return 1.0;
    const double radius = bearing.contact->radius, ratio = radius / bearing.contact->clearance;
    double most = kClearanceShare * ratio;
    if (motion > 0.0) {
      most = std::clamp(kRingMotionShare * radius / motion, kLeastShare * ratio, most);
    }
    least = std::min(least, most);
  }
  return std::max(1.0, plain_number_below(least));
}

double plain_number_below(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  double best = power;
  for (const double plain : {1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0}) {
    if (plain * power <= value * (1.0 + 1e-12)) best = plain * power;
  }
  return best;
}

Machine Machine::with_contact_of(const Machine& other) const {
  Machine machine = *this;
  machine.contact = other.contact;
  machine.contact->clearance *= magnification / other.magnification;
  machine.contact->ring_outer += machine.contact->clearance - other.contact->clearance;
  machine.clearance = other.clearance;
  machine.support = other.support;
  machine.ring_turns = other.ring_turns;
  return machine;
}

Eigen::Matrix2Xd Machine::centre_line(const Pose& pose) const {
  Eigen::Matrix2Xd line(2, z.size());
  if (bow.size() > 0) {
    line.row(0) = bow.transpose() * pose.rotor[0];
    line.row(1) = bow.transpose() * pose.rotor[1];
  } else {
    line.row(0) = (modes_x * pose.x).transpose();
    line.row(1) = (modes_y * pose.y).transpose();
  }
  return line * displaced(1.0);
}

Eigen::Vector3d Machine::centre(const Eigen::Matrix2Xd& line, double station) const {
  const Eigen::Vector2d at =
      resample(z, line.transpose(), Eigen::VectorXd::Constant(1, station)).row(0).transpose();
  return {station, at[0], at[1]};
}

Eigen::Vector3d Machine::tangent(const Eigen::Matrix2Xd& line, double station) const {
  constexpr double kReach = 0.03;
  const double before = std::max(0.0, station - kReach);
  const double after = std::min(1.0, station + kReach);
  return (centre(line, after) - centre(line, before)).normalized();
}

Machine make_machine(const scene::Scene& scene, std::span<const Playback* const> runs, double from,
                     double to, std::optional<double> magnification) {
  Machine machine;
  if (scene.rotor.geometry) {
    draw_geometry(machine, scene);
    for (const Playback* run : runs) {
      if (machine.modes_x.cols() == run->modes()) continue;
      throw std::runtime_error(
          fmt::format("the series has {} bending modes and the scene `{}` has {}: they do not "
                      "belong together",
                      run->modes(), scene.name, machine.modes_x.cols()));
    }
  } else {
    draw_modal(machine, scene);
  }
  // The largest motion of any station, with magnification 1.
  const double motion = largest(machine, runs, from, to, 600, [](const Eigen::Matrix2Xd& line) {
    return line.colwise().norm().maxCoeff();
  });
  machine.magnification =
      magnification.value_or(machine_magnification(scene, machine.unit, motion));
  if (scene.has_contact()) draw_contact(machine, scene);
  draw_loads(machine, scene);
  for (const scene::MagneticBearing& bearing : scene.magnetic_bearings) {
    if (!scene.rotor.geometry) break;
    const double station = bearing.station;
    const double z = station * machine.unit;
    const double shaft = 0.5 * diameter_at(*scene.rotor.geometry, station);
    const double moved = largest(machine, runs, from, to, 200, [&](const Eigen::Matrix2Xd& line) {
      return machine.centre(line, z).tail<2>().norm();
    });
    const double bore = 1.6 * shaft * machine.unit + moved;
    machine.magnetic_bearings.push_back({z, bore, bore + 0.035, 0.025});
  }

  // The base plate is below all moving parts.
  double reach = 0.08;
  for (const Playback* run : runs) {
    if (!machine.contact) break;
    reach = std::max(reach, machine.contact->ring_outer +
                                machine.displaced(run->largest_stator(from, to)) + 0.06);
  }
  for (const DrawnDisc& disc : machine.discs) {
    reach = std::max(reach, disc.radius + motion * machine.magnification + 0.02);
  }
  for (const DrawnMagneticBearing& magnet : machine.magnetic_bearings) {
    reach = std::max(reach, magnet.outer + 0.02);
  }
  machine.floor = -reach;
  return machine;
}

}  // namespace rotorub::renders
