// The scene: everything a user can say about a rotor, its auxiliary bearing and a run, as plain
// structs in SI units. A part that the scene leaves out is an empty optional (or vector) and costs
// nothing in either model.
//
// Axes: z along the shaft, right-handed; x, y the bending planes; spin about +z.
// Units: m, kg, s, N, rad. Speeds of rotation and frequencies in rad/s.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/contact/most_contacts.h"
#include "native_model/scene/auxiliary_bearing.h"
#include "native_model/scene/magnetic_bearing.h"

namespace rotorub {
struct ModalRotor;  // rotor/modal_rotor.h
}

namespace rotorub::scene {

class Record;

// ---------------------------------------------------------------- [run]
enum class Integrator { kEvent, kMidpoint, kVerlet, kEuler };

struct Run {                                   // how long, how finely, and what is written
  double end = 1.0;                            // s, > 0
  double step = 1e-5;                          // s, > 0: fixed step of `midpoint` and of MuJoCo
  Integrator integrator = Integrator::kEvent;  // of the native engine
  std::optional<double> output_step;           // s, > 0; default end / 1000
  std::vector<double> output_times;            // s, in [0, end], ascending after reading
  double series_step() const { return output_step.value_or(end / 1000.0); }
};

// ---------------------------------------------------------------- [rotor]
struct ShaftSection {
  double from = 0.0;            // m, axial range [from, to] of the section
  double to = 0.0;              // m
  double diameter = 0.0;        // m, > 0, outer
  double inner_diameter = 0.0;  // m, in [0, diameter)
  // At `to`; empty: as at `from`. In between both change evenly: a cone.
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

  // Other words for mass, Jt, Jp and for eccentricity, which have them after reading
  // (scene/disc.h).
  std::optional<double> diameter{}, inner_diameter{}, thickness{};  // m
  std::optional<double> rho{};                                      // kg/m^3
  std::optional<double> unbalance{};                                // kg m
  std::string balance_grade{};                                      // "G 2.5"; empty: none
  std::optional<double> balance_speed{};                            // rad/s
};

// Beyond stiffness and damping: bearing/bearing_film.h.
struct ShaftBearing {
  double z = 0.0;                 // m, station
  PlanePair stiffness{0.0, 0.0};  // N/m, >= 0; after reading of rotor.speed, where there is a table
  PlanePair damping{0.0, 0.0};    // N s/m, >= 0; alike
  Eigen::Vector2d cross_stiffness{0.0, 0.0};  // N/m, k_xy, k_yx
  Eigen::Vector2d cross_damping{0.0, 0.0};    // N s/m, c_xy, c_yx
  Eigen::Vector2d offset{0.0, 0.0};           // m, where it stands off the line x = y = 0

  // The coefficients over the speed of rotation, in place of the four above: rad/s, ascending; each
  // as long or empty.
  std::vector<double> table_speed{};
  std::vector<double> table_kxx{}, table_kxy{}, table_kyx{}, table_kyy{};  // N/m; kyy empty: as kxx
  std::vector<double> table_cxx{}, table_cxy{}, table_cyx{},
      table_cyy{};  // N s/m; cyy empty: as cxx

  bool follows_speed() const { return !table_speed.empty(); }
  bool crosses() const { return !cross_stiffness.isZero(0.0) || !cross_damping.isZero(0.0); }
};

// Geometry form: a continuous Euler-Bernoulli shaft.
struct RotorGeometry {
  double length = 0.0;                  // m, > 0
  double E = 0.0;                       // Pa, > 0
  std::optional<double> nu;             // 1, in (-1, 0.5]; at most one of nu and G
  double G = 0.0;                       // Pa, > 0: given, or E / (2 (1 + nu)); nu: 0.3
  double rho = 0.0;                     // kg/m^3, > 0
  std::optional<int> modes;             // bending modes kept in each plane, >= 1
  bool auto_modes = false;              // as few as modes_tolerance allows; then `modes` is empty
  double modes_tolerance = 0.01;        // share, in (0, 1): rotor/mode_truncation.h
  std::optional<double> max_frequency;  // rad/s: modes kept up to this frequency
  double damping_ratio = 0.0;           // external modal damping, >= 0
  double internal_damping_ratio = 0.0;  // rotating modal damping, >= 0
  std::vector<ShaftSection> sections;   // contiguous from 0 to length
  std::vector<Disc> discs;
  std::vector<ShaftBearing> bearings;
};

// Modal form: every bending mode scaled to 1 at the contact station. All of one length n >= 1.
struct RotorModal {
  std::vector<double> mass, mass_y;            // kg, > 0
  std::vector<double> stiffness, stiffness_y;  // N/m, >= 0
  std::vector<double> damping, damping_y;      // N s/m, >= 0, external (inertial frame)
  std::vector<double> internal_damping;        // N s/m, >= 0, rotating with the shaft
  std::vector<double> gyroscopic;              // kg: force on x: -Omega g vy, on y: +Omega g vx
  double inertia = 0.0;                        // kg m^2, > 0 with [drive]: rigid spin
};

// Geometry form: `modes` elastic torsion modes. Modal form: the lists, one length, every mode 1 at
// the contact station.
struct Torsion {
  int modes = 0;                    // geometry form, >= 1
  double damping_ratio = 0.0;       // geometry form, >= 0; default: [rotor].damping_ratio
  std::vector<double> inertia;      // kg m^2, > 0
  std::vector<double> stiffness;    // N m/rad, > 0
  std::vector<double> damping;      // N m s/rad, >= 0
  std::vector<double> drive_shape;  // 1, mode value at the motor, default 0
};

struct Rotor {                            // the shaft with what sits on it
  double speed = 0.0;                     // rad/s, Omega at t = 0; constant without [drive]
  std::optional<RotorGeometry> geometry;  // exactly one of geometry and modal
  std::optional<RotorModal> modal;
  // Beside `modal`, which then is for pictures alone: the rotor as it is, of a machine without a
  // scene file (plugin/twin/native_twin.h).
  std::shared_ptr<const ModalRotor> assembled;
  std::optional<Torsion> torsion;
};

// ---------------------------------------------------------------- [drive]
enum class DriveKind { kFree, kLinear, kKloss, kTable, kSpeedControlled };

struct Drive {  // what turns the shaft: its torque over speed and time
  DriveKind kind = DriveKind::kFree;
  double gain = 0.0;                 // linear, speed_controlled: N m s, >= 0; bearing/drive.h
  double speed = 0.0;                // the same: rad/s
  double breakdown_torque = 0.0;     // kloss: N m, > 0
  double breakdown_slip = 0.0;       // kloss: 1, > 0
  double synchronous_speed = 0.0;    // kloss: rad/s, > 0
  std::vector<double> table_speed;   // table: rad/s, ascending, at least 2
  std::vector<double> table_torque;  // table: N m
  // speed_controlled: PI on the motor's speed, its reference rising from rotor.speed to `speed`
  double integral_gain = 0.0;                                     // N m, >= 0, per rad left behind
  double torque_limit = std::numeric_limits<double>::infinity();  // N m, > 0
  double acceleration = std::numeric_limits<double>::infinity();  // rad/s^2, > 0; infinity: at once
  double station = 0.0;                                           // m, geometry form
  double inertia = 0.0;  // kg m^2, >= 0, geometry form: of the motor's rotor at `station`
};

// ---------------------------------------------------------------- [[force]]
enum class ForceKind { kRotating, kConstant, kSynchronous, kChirp, kPulse, kUnbalance };

// Acts for on <= t < off, rising linearly from 0 over [on, on + ramp]. amplitude (cos a, sin a):
//   rotating:    a = frequency t + phase, t absolute
//   synchronous: a = phi + phase, phi the spin's angle; an outer force, without torque on the spin
//   chirp:       a' from `frequency` at `on` to `frequency_end` at `off`, linearly in time;
//                a = phase at `on`
// constant: vector; pulse: vector sin(pi (t - on)/(off - on)). unbalance: no outer force but a mass
// out of the axis from `on` for ever (a blade is lost), as rotor.disc's eccentricity.
struct Force {
  ForceKind kind = ForceKind::kRotating;
  double amplitude = 0.0;            // N; turned by pi if negative
  double frequency = 0.0;            // rad/s, rotating, chirp; negative: backward
  double frequency_end = 0.0;        // rad/s, chirp
  double phase = 0.0;                // rad; unbalance: from the rotor's own x axis
  double static_moment = 0.0;        // kg m, >= 0, unbalance: mass times eccentricity
  Eigen::Vector2d vector{0.0, 0.0};  // N, constant, pulse
  double on = 0.0;                   // s
  double off = kNever;               // s
  double ramp = 0.0;                 // s, >= 0
  std::vector<double> shape;         // modal form: mode values at the station, default all 1
  double station = 0.0;              // m, geometry form
};

// ---------------------------------------------------------------- [gravity], [initial], [mujoco]
// Acceleration in the plane of the bending modes. Modal form: `participation` is the load of each
// mode per unit acceleration (kg), default the modal mass.
struct Gravity {
  Eigen::Vector2d acceleration{0.0, 0.0};  // m/s^2
  std::vector<double> participation;       // kg
};

// ---------------------------------------------------------------- [base]
// How bearings, rings and actuators are accelerated: system/base_motion.h.
struct Base {
  std::vector<double> time;                            // s, ascending, none or at least 2
  std::vector<double> acceleration_x, acceleration_y;  // m/s^2, at each time; empty: 0
  std::vector<double> frequency, amplitude, phase;     // rad/s >= 0, m/s^2, rad of each line
  std::optional<int> seed;                             // >= 0: gives the phases
  double direction = 0.0;                              // rad, of the lines
  double on = 0.0;                                     // s
  double off = kNever;                                 // s
  double ramp = 0.0;                                   // s, >= 0
};

// The lasting rub that a run starts on (rub/rub_start.h).
enum class StartingRub { kNone, kSynchronous, kWhip, kRolling };

// Missing lists mean 0. Modal coordinates at t = 0. steady: on the steady free orbit
// (system/steady_orbit.h); the lists then are added to it, or to the rub.
struct Initial {
  bool steady = false;
  StartingRub rub = StartingRub::kNone;
  std::vector<double> x, y, vx, vy;            // m, m/s
  double spin_angle = 0.0;                     // rad
  std::vector<double> torsion, torsion_speed;  // rad, rad/s
};

enum class MujocoRotor { kModal, kSegments };                       // modes, or rigid pieces
enum class ContactModel { kRigid, kCoulomb, kCone, kConeCoulomb };  // kContactModels
enum class MujocoIntegrator { kEuler, kImplicit, kRk4 };            // MuJoCo's own
enum class MujocoSolver { kNewton, kCg, kPgs };                     // MuJoCo's own

struct Mujoco {  // how the scene is put into MuJoCo, and solved there
  MujocoRotor rotor = MujocoRotor::kModal;
  int segments = 16;  // of the segment rotor, [2, 200]
  ContactModel contact = ContactModel::kRigid;
  MujocoIntegrator integrator = MujocoIntegrator::kEuler;
  MujocoSolver solver = MujocoSolver::kNewton;
  double solref_stiffness = 0.0;    // 1/s^2, > 0: direct solref K (0: mjcf/soft_contact.h)
  double solref_damping = 0.0;      // 1/s, > 0: direct solref B (0: that of contact.restitution)
  double friction_reference = 0.0;  // 1/s, > 0: B_t of the cone's friction rows (0: MuJoCo's, B)
  bool shadow = false;              // the native model runs alongside, in user sensors
  bool bearing_currents = false;    // actuators that add to what the amplifiers are asked for
};

// The contact models of MuJoCo's side and their words: in scene files, options, columns and
// reports.
struct ContactWord {
  ContactModel model;
  const char* word;
};

// In the order of the enum, which is that of every table.
inline constexpr std::array kContactModels{ContactWord{ContactModel::kRigid, "rigid"},
                                           ContactWord{ContactModel::kCoulomb, "coulomb"},
                                           ContactWord{ContactModel::kCone, "cone"},
                                           ContactWord{ContactModel::kConeCoulomb, "cone-coulomb"}};

constexpr const char* to_string(ContactModel model) {  // its word
  return kContactModels[static_cast<std::size_t>(model)].word;
}

// Of a word; none: no contact model is called so.
constexpr std::optional<ContactModel> contact_model(std::string_view word) {
  for (const ContactWord& w : kContactModels) {
    if (word == w.word) return w.model;
  }
  return std::nullopt;
}

// Normal force and friction are both found by MuJoCo's solver, in its friction cone.
constexpr bool is_cone(ContactModel model) {
  return model == ContactModel::kCone || model == ContactModel::kConeCoulomb;
}

// Container of words, as schemas and options take them.
template <typename Words>
Words contact_words() {
  Words words;
  for (const ContactWord& w : kContactModels) words.emplace_back(w.word);
  return words;
}

// ---------------------------------------------------------------- the whole
struct Scene {
  std::string name;  // file name without folder and ending
  std::string text;  // TOML with overrides applied; what the MJCF carries and the hash is of
  Run run;
  Rotor rotor;
  std::optional<Drive> drive;
  std::vector<Force> forces;
  // [magnetic_bearing], or each [[magnetic_bearing]]; at most kMaxMagneticBearings.
  std::vector<MagneticBearing> magnetic_bearings;
  std::optional<SharedControl> magnetic_control;
  // One at least: [contact], [stator], [actuator] and [controller] at the top of a file, which may
  // all be absent, or those of its [[contact]] in their order; at most kMaxContacts.
  std::vector<AuxiliaryBearing> auxiliary = std::vector<AuxiliaryBearing>(1);
  AuxiliaryBearing& first() { return auxiliary.front(); }
  const AuxiliaryBearing& first() const { return auxiliary.front(); }
  // Of a bearing that is not named its number, from 1.
  std::string name_of(std::size_t bearing) const {
    const std::string& own = auxiliary[bearing].name;
    return own.empty() ? std::to_string(bearing + 1) : own;
  }
  // A contact at least is compliant.
  bool gives() const {
    return std::any_of(auxiliary.begin(), auxiliary.end(), [](const AuxiliaryBearing& at) {
      return at.contact && at.contact->compliance;
    });
  }
  // An ensemble takes it as one of many side by side (stepping/ensemble.h).
  bool fits_lanes() const {
    const std::optional<Stator>& ring = first().stator;
    return auxiliary.size() == 1 && !gives() && (!ring || ring->on_springs_alone()) &&
           !(magnetic_control && magnetic_control->by_library());
  }
  // Which one of the file's list the first is: 0 but for with_bearing_alone.
  std::size_t first_index = 0;
  std::optional<Gravity> gravity;
  std::optional<Base> base;
  Initial initial;
  Mujoco mujoco;
  // Of the file that it was read from; absent: it came in a model (MJCF) or was made by hand.
  std::optional<std::string> folder;
  // Where its keys stand in the file (record.h), for what is found wrong later; null: made by hand.
  std::shared_ptr<const Record> record;
  // What its user ought to know although it is accepted, a sentence each: words with a new name.
  std::vector<std::string> notes;
};

// The scene with one of its auxiliary bearings; messages name that one's keys.
Scene with_bearing_alone(const Scene& scene, std::size_t bearing);

}  // namespace rotorub::scene
