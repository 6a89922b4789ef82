// The auxiliary bearing of a scene, [[contact]]: where the rotor may touch, the ring there, what
// moves it and what commands that. SI units.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "native_model/contact/compliance.h"
#include "native_model/contact/friction.h"
#include "native_model/scene/config_entry.h"

namespace rotorub::scene {

// The value along the bending planes x and y; a single number in the file means both.
using PlanePair = Eigen::Vector2d;

// ---------------------------------------------------------------- [contact]
struct Contact {
  double radius = 0.0;     // m, > 0, of the rotor at the contact
  double clearance = 0.0;  // m, > 0, delta_0
  FrictionLaw friction{};
  double restitution = 0.0;                // 1, [0, 1], eps_N
  double tangential_restitution = 0.0;     // 1, [0, 1], eps_T
  double compression_time = 0.0;           // s, >= 0, tau_C
  double expansion_time = 0.0;             // s, >= 0, tau_E
  std::optional<Compliance> compliance{};  // absent: the contact is rigid
  double station = 0.0;                    // m, geometry form
  // m: of the ring's middle at rest from the line of x = y = 0, off which deflections are counted.
  Eigen::Vector2d offset{0.0, 0.0};
  // Modal form: value of each mode at the station; empty: all 1, as those of the first contact are.
  std::vector<double> shape{}, torsion_shape{};
};

// ---------------------------------------------------------------- [stator], [actuator]
// The ring turns about its axis, as the inner ring of an auxiliary ball bearing does: J Omega_r' =
// torque of the contact - drag Omega_r - (dry_drag + load_factor pitch_diameter P) s, s in [-1, 1]
// the state of dry friction (bearing/ring_support.h) and P the size of the force that the ring's
// support transmits (Palmgren 1959: M_1 = f_1 P d_m).
struct RingSpin {
  double inertia = 0.0;            // kg m^2, > 0, polar, of all that turns with the ring
  double drag = 0.0;               // N m s, >= 0, viscous, to the base
  double speed = 0.0;              // rad/s, about +z, at t = 0
  double dry_drag = 0.0;           // N m, >= 0, at no load
  double load_factor = 0.0;        // 1, >= 0, f_1; needs a ring that moves
  double pitch_diameter = 0.0;     // m, > 0, d_m, of the balls' circle
  double presliding_angle = 0.01;  // rad, > 0: by how much it turns before the drag acts in full
  bool drags() const { return dry_drag > 0.0 || load_factor > 0.0; }
};

// What carries the ring: stator.stiffness and stator.damping then are between ring and housing.
struct Housing {
  PlanePair mass{0.0, 0.0};       // kg, > 0
  PlanePair stiffness{0.0, 0.0};  // N/m, >= 0, to the base
  PlanePair damping{0.0, 0.0};    // N s/m, >= 0, to the base
};

// Between the ring and what carries it, beside spring and damper: bearing/ring_support.h.
struct DryFriction {
  double force = 0.0;       // N, > 0, in full slip
  double presliding = 0.0;  // m, > 0: the way on which it rises to that
};
struct SqueezeFilm {
  double radius = 0.0;     // m, > 0, of the journal: the ring's outside
  double length = 0.0;     // m, > 0, axial
  double clearance = 0.0;  // m, > 0, radial
  double viscosity = 0.0;  // Pa s, > 0
  bool cavitation = true;  // the film bears no tension
};
struct BallSupport {
  int balls = 0;           // >= 3
  double stiffness = 0.0;  // N/m^1.5, > 0, of a ball between its two races
  double play = 0.0;       // m, >= 0, radial: how far the ring moves until the first ball bears
  double phase = 0.0;      // rad, of the first ball from the x axis
};

// The ring of the auxiliary bearing; absent: fixed to the base.
struct Stator {
  PlanePair mass{0.0, 0.0};        // kg, > 0
  PlanePair damping{0.0, 0.0};     // N s/m, >= 0
  PlanePair stiffness{0.0, 0.0};   // N/m, >= 0, mechanical spring to the base, always acting
  std::optional<RingSpin> spin{};  // absent: the ring does not turn
  std::optional<Housing> mount{};  // absent: the base carries the ring
  std::optional<DryFriction> dry_friction{};
  std::optional<SqueezeFilm> squeeze_film{};
  std::optional<BallSupport> ball_bearing{};
  Eigen::Vector2d position{0.0, 0.0};  // m, at t = 0, from where it is at rest
  Eigen::Vector2d velocity{0.0, 0.0};  // m/s, at t = 0
  // Nothing carries the ring, or drags its spin, but springs and viscous dampers to the base.
  bool on_springs_alone() const {
    return !mount && !dry_friction && !squeeze_film && !ball_bearing && !(spin && spin->drags());
  }
};

enum class ActuatorKind { kIdeal, kElectromagnet, kTable };  // its force law

// Two axes at 45 degrees, a_1 = (1, 1)/sqrt 2, a_2 = (-1, 1)/sqrt 2.
struct Actuator {
  ActuatorKind kind = ActuatorKind::kIdeal;
  // ideal: the force asked for, limited
  double force_limit = std::numeric_limits<double>::infinity();  // N, > 0, on each axis
  // electromagnet: F(s, i) of bearing/actuator.h on each axis
  double force_constant = 0.0;  // N m^2/A^2, k_m > 0
  double bias_current = 0.0;    // A, i_0 > 0
  double air_gap = 0.0;         // m, s_0 > 0
  double stiffness = 0.0;       // N/m, c >= 0
  // table: F(s, i) of bearing/actuator.h
  std::vector<double> table_position{};  // m, ascending
  std::vector<double> table_current{};   // A, ascending
  std::vector<double> table_force{};     // N, position by position, one for each current
  // both
  double current_limit = 0.0;  // A, of |i|, > 0, at most bias_current or the table's; 0: that much
  // The coil's current follows the one asked for: lag di/dt = asked - i, as far as |di/dt| is
  // allowed and the amplifier's voltage reaches: L di/dt = u - R i, |u| <= voltage_limit.
  double coil_lag = 0.0;                                                // s, >= 0; 0: at once
  double current_rate_limit = std::numeric_limits<double>::infinity();  // A/s, > 0, needs coil_lag
  double voltage_limit =
      std::numeric_limits<double>::infinity();  // V, > 0, needs coil_lag and inductance
  double inductance = 0.0;                      // H, > 0, L of an axis
  double resistance = 0.0;                      // Ohm, >= 0, R of an axis
};

// ---------------------------------------------------------------- [controller]
enum class ControllerKind {
  kPassive,
  kSliding,
  kCrossCoupled,
  kTwoPhase,
  kPd,
  kLqr,
  kLqg,
  kLibrary
};

// How a sampled controller comes by the velocities of rotor and ring: measured, from the positions
// of two samples, or not at all.
enum class VelocitySensor { kMeasured, kDifference, kNone };

// What a sampled controller is shown. Noise: standard deviation of each number, independent of all
// others; resolution: numbers are rounded to its multiples; 0: none.
struct Sensors {
  bool rotor = true, stator = true, spin = true, current = true;  // measured
  VelocitySensor velocity = VelocitySensor::kMeasured;
  double delay = 0.0;                // s, >= 0, a whole number of samples
  double position_resolution = 0.0;  // m
  double velocity_resolution = 0.0;  // m/s
  double current_resolution = 0.0;   // A
  double position_noise = 0.0;       // m
  double velocity_noise = 0.0;       // m/s
  double current_noise = 0.0;        // A
  int seed = 1;                      // of the noise
};

// What switches a sampled controller on, from Controller::on on: whichever comes first.
struct Trigger {
  std::optional<double> gap;            // m, > 0: the gap is that small
  std::optional<double> time_to_touch;  // s, > 0: at its present rate it is closed within this time
  bool touch = false;                   // rotor and ring have touched
};

enum class BoundaryLayer { kConstant, kAdaptive };  // of sliding mode: its width

struct Controller {  // what commands the ring
  ControllerKind kind = ControllerKind::kPassive;
  double on = 0.0;           // s, switch-on time; with a trigger from when on that is looked for
  double sample_time = 0.0;  // s, >= 0; 0: continuous
  Sensors sensors;
  std::optional<Trigger> trigger;
  // library
  std::string library;              // file, beside the scene's or absolute
  std::vector<ConfigEntry> config;  // what it is given
  // sliding mode with boundary layer (22)-(29), tracking q_fd = r_rotor - (delta_0 - g_d) e_r
  double bandwidth = 1500.0;                       // 1/s, psi, > 0
  double boundary_layer = 0.03;                    // m/s, phi, > 0
  BoundaryLayer layer = BoundaryLayer::kConstant;  // adaptive: (27), phi' + psi phi = k
  double switching_gain = 120.0;  // m/s^2, k, >= 0: bound on the unknown acceleration
  double gap_time = 0.008;        // s, > 0: the gap reference falls smoothly to 0 in this time
  // With the gap reference at 0 the normal force of the lasting contact. 0 leaves the two grazing.
  double preload = 20.0;    // N, >= 0
  double mass_error = 0.0;  // > -1: by this share the law takes the ring for heavier than it is
  // Sampled: mean of the feed-forward in the frame of the whirl; standard: one turn of the spin
  std::optional<double> filter_time;  // s, >= 0
  // and damping of the ring's velocity about its mean there; standard: the ring's critical one
  std::optional<double> tracking_damping;  // N s/m, >= 0
  // passive: an extra spring and damper emulated through the actuator; pd: of the tracking error
  double stiffness = 0.0;  // N/m, >= 0
  double damping = 0.0;    // N s/m, >= 0
  // cross_coupled, two_phase: k(Omega), one value or one for each speed
  std::vector<double> feedback;        // N s/m, >= 0
  std::vector<double> feedback_speed;  // rad/s, >= 0, ascending
  double handover_time = 0.005;        // s, > 0, two_phase: in which the tracking force fades out
  // lqr, lqg: what is allowed, all > 0
  double allowed_error = 1e-4;   // m, of the rotor's distance from the ring's centre
  double allowed_travel = 1e-3;  // m, of the ring
  double allowed_force = 100.0;  // N
  // lqg: standard deviations, > 0
  double disturbance = 10.0;        // N, of forces on rotor and ring at the contact
  double measurement_error = 1e-6;  // m, of the positions
};

// ---------------------------------------------------------------- [[contact]]
// One auxiliary bearing: where the rotor may touch, the ring there and what moves it.
struct AuxiliaryBearing {
  std::string name{};  // unique; empty: its number, from 1
  std::optional<Contact> contact;
  std::optional<Stator> stator;
  std::optional<Actuator> actuator;
  std::optional<Controller> controller;
};

}  // namespace rotorub::scene
