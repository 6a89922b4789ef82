// [rotor] of a scene (scene.h): the shaft and the parts on it.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "native_model/film/journal_bearing.h"
#include "native_model/scene/auxiliary_bearing.h"

namespace rotorub {
struct ModalRotor;  // rotor/modal_rotor.h
}

namespace rotorub::scene {

struct ShaftSection {           // a cylindrical or conical part of the shaft
  double from = 0.0;            // m, axial range [from, to] of the section
  double to = 0.0;              // m
  double diameter = 0.0;        // m, > 0, outer
  double inner_diameter = 0.0;  // m, in [0, diameter)
  // Diameters at `to`; empty: as at `from`. In between they vary linearly: a cone.
  std::optional<double> end_diameter{}, end_inner_diameter{};  // m

  bool tapered() const { return end_diameter || end_inner_diameter; }
  // Outer and inner diameter, m, at z in [from, to].
  double outer_at(double z) const { return between(diameter, end_diameter.value_or(diameter), z); }
  double inner_at(double z) const {
    return between(inner_diameter, end_inner_diameter.value_or(inner_diameter), z);
  }

 private:
  double between(double first, double last, double z) const {
    return first == last ? first : first + (last - first) * (z - from) / (to - from);
  }
};

struct Disc {                 // a rigid disc on the shaft
  double z = 0.0;             // m, station
  double mass = 0.0;          // kg, >= 0
  double Jt = 0.0;            // kg m^2, >= 0, diametral
  double Jp = 0.0;            // kg m^2, >= 0, polar, about the shaft axis
  double eccentricity = 0.0;  // m, >= 0, of the centre of mass
  double phase = 0.0;         // rad, of the eccentricity from the rotor-fixed x axis

  // Alternatives to mass, Jt, Jp and eccentricity, which are computed from them after reading
  // (scene/disc.h).
  std::optional<double> diameter{}, inner_diameter{}, thickness{};  // m
  std::optional<double> rho{};                                      // kg/m^3
  std::optional<double> unbalance{};                                // kg m
  std::string balance_grade{};                                      // "G 2.5"; empty: none
  std::optional<double> balance_speed{};                            // rad/s
};

// The body between a bearing and the base. The bearing's law then acts between the shaft and it.
struct Pedestal {
  double mass = 0.0;              // kg, > 0
  PlanePair stiffness{0.0, 0.0};  // N/m, > 0, to the base
  PlanePair damping{0.0, 0.0};    // N s/m, >= 0, to the base
};

// A bearing of the shaft. Its full law is in bearing/bearing_film.h.
struct ShaftBearing {
  double z = 0.0;                             // m, station
  PlanePair stiffness{0.0, 0.0};              // N/m, >= 0; from a table: value at rotor.speed
  PlanePair damping{0.0, 0.0};                // N s/m, >= 0; likewise
  Eigen::Vector2d cross_stiffness{0.0, 0.0};  // N/m, k_xy, k_yx
  Eigen::Vector2d cross_damping{0.0, 0.0};    // N s/m, c_xy, c_yx
  Eigen::Vector2d offset{0.0, 0.0};           // m, from the line x = y = 0

  std::optional<Pedestal> pedestal{};  // absent: the base carries the bearing

  // A plain bearing given by its dimensions, instead of coefficients. `complete` fills the table
  // below from it.
  std::optional<JournalBearing> journal{};

  // The coefficients as functions of the rotational speed (rad/s, ascending), instead of the four
  // members above. Each list has the length of table_speed or is empty.
  std::vector<double> table_speed{};
  std::vector<double> table_kxx{}, table_kxy{}, table_kyx{}, table_kyy{};  // N/m; kyy empty: as kxx
  std::vector<double> table_cxx{}, table_cxy{}, table_cyx{},
      table_cyy{};  // N s/m; cyy empty: as cxx

  bool follows_speed() const { return journal || !table_speed.empty(); }
  bool crosses() const { return !cross_stiffness.isZero(0.0) || !cross_damping.isZero(0.0); }
};

// The beam theory of the shaft: without or with shear deformation. Both have rotary inertia.
enum class ShaftTheory { kEulerBernoulli, kTimoshenko };

// Geometry form: a continuous shaft.
struct RotorGeometry {
  double length = 0.0;       // m, > 0
  double E = 0.0;            // Pa, > 0
  std::optional<double> nu;  // 1, in (-1, 0.5]; at most one of nu and G
  double G = 0.0;            // Pa, > 0: given, or E / (2 (1 + nu)) with nu = 0.3 by default
  double rho = 0.0;          // kg/m^3, > 0
  ShaftTheory theory = ShaftTheory::kEulerBernoulli;
  // 1, > 0, shear area of a cross-section divided by its area; empty: by Cowper
  // (rotor/shaft_basis.h). Only with kTimoshenko.
  std::optional<double> shear_coefficient;
  double axial_force = 0.0;             // N, constant along the shaft, tension positive
  std::optional<int> modes;             // bending modes kept in each plane, >= 1
  bool auto_modes = false;              // as few as modes_tolerance allows; `modes` is then empty
  double modes_tolerance = 0.01;        // relative, in (0, 1): rotor/mode_truncation.h
  std::optional<double> max_frequency;  // rad/s: modes kept up to this frequency
  double damping_ratio = 0.0;           // external modal damping, >= 0
  double internal_damping_ratio = 0.0;  // rotating modal damping, >= 0
  std::vector<ShaftSection> sections;   // contiguous from 0 to length
  std::vector<Disc> discs;
  std::vector<ShaftBearing> bearings;
};

// Modal form: every bending mode is scaled to 1 at the contact station. All lists have the same
// length n >= 1.
struct RotorModal {
  std::vector<double> mass, mass_y;            // kg, > 0
  std::vector<double> stiffness, stiffness_y;  // N/m, >= 0
  std::vector<double> damping, damping_y;      // N s/m, >= 0, external (inertial frame)
  std::vector<double> internal_damping;        // N s/m, >= 0, rotating with the shaft
  std::vector<double> gyroscopic;              // kg: force on x: -Omega g vy, on y: +Omega g vx
  double inertia = 0.0;                        // kg m^2, > 0 with [drive]: of the rigid spin
};

// Geometry form: `modes` elastic torsion modes. Modal form: the lists, all of one length, with
// every mode scaled to 1 at the contact station.
struct Torsion {
  int modes = 0;                    // geometry form, >= 1
  double damping_ratio = 0.0;       // geometry form, >= 0; default: [rotor].damping_ratio
  std::vector<double> inertia;      // kg m^2, > 0
  std::vector<double> stiffness;    // N m/rad, > 0
  std::vector<double> damping;      // N m s/rad, >= 0
  std::vector<double> drive_shape;  // 1, mode value at the motor, default 0
};

struct Rotor {                            // the shaft and the parts on it
  double speed = 0.0;                     // rad/s, Omega at t = 0; constant without [drive]
  std::optional<RotorGeometry> geometry;  // exactly one of geometry and modal
  std::optional<RotorModal> modal;
  // The rotor of a machine without a scene file (plugin/twin/native_twin.h). `modal` then serves
  // only for pictures.
  std::shared_ptr<const ModalRotor> assembled;
  std::optional<Torsion> torsion;
};

}  // namespace rotorub::scene
