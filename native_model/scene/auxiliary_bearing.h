// The auxiliary bearings of a scene, [[contact]]: the contact with the rotor, the ring, its
// actuator and its controller. SI units.
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

// One value for each bending plane, x and y. A single number in the file sets both.
using PlanePair = Eigen::Vector2d;

// ---------------------------------------------------------------- [contact]
struct Contact {
  double radius = 0.0;     // m, > 0, of the rotor at the contact
  double clearance = 0.0;  // m, > 0, delta_0, radial
  FrictionLaw friction{};
  double restitution = 0.0;                // 1, [0, 1], eps_N
  double tangential_restitution = 0.0;     // 1, [0, 1], eps_T
  double compression_time = 0.0;           // s, >= 0, tau_C
  double expansion_time = 0.0;             // s, >= 0, tau_E
  std::optional<Compliance> compliance{};  // absent: rigid contact
  double station = 0.0;                    // m, geometry form
  // m, position of the ring's centre at rest, relative to the line x = y = 0 from which deflections
  // are measured.
  Eigen::Vector2d offset{0.0, 0.0};
  // Modal form: value of each mode at the station. Empty: all 1, as at the first contact.
  std::vector<double> shape{}, torsion_shape{};
};

// ---------------------------------------------------------------- [stator], [actuator]
// Spin of the ring about its axis, as of the inner ring of an auxiliary ball bearing:
//   J Omega_r' = T - drag Omega_r - (dry_drag + load_factor pitch_diameter P) s,
// with T the torque of the contact, s in [-1, 1] the state of the dry friction
// (bearing/ring_support.h) and P the magnitude of the force that the ring's support transmits
// (Palmgren 1959: M_1 = f_1 P d_m).
struct RingSpin {
  double inertia = 0.0;            // kg m^2, > 0, polar, of everything that turns with the ring
  double drag = 0.0;               // N m s, >= 0, viscous, to the base
  double speed = 0.0;              // rad/s, about +z, at t = 0
  double dry_drag = 0.0;           // N m, >= 0, without load
  double load_factor = 0.0;        // 1, >= 0, f_1; needs a movable ring
  double pitch_diameter = 0.0;     // m, > 0, d_m, of the ball circle
  double presliding_angle = 0.01;  // rad, > 0, rotation over which the drag builds up
  bool drags() const { return dry_drag > 0.0 || load_factor > 0.0; }
};

// The body that carries the ring. stator.stiffness and stator.damping then act between the two.
struct Housing {
  PlanePair mass{0.0, 0.0};       // kg, > 0
  PlanePair stiffness{0.0, 0.0};  // N/m, >= 0, to the base
  PlanePair damping{0.0, 0.0};    // N s/m, >= 0, to the base
};

// These act between the ring and the part that carries it, in addition to spring and damper; see
// bearing/ring_support.h.
struct DryFriction {
  double force = 0.0;       // N, > 0, at full slip
  double presliding = 0.0;  // m, > 0, displacement over which the force builds up
};
struct SqueezeFilm {
  double radius = 0.0;     // m, > 0, of the journal, which is the outside of the ring
  double length = 0.0;     // m, > 0, axial
  double clearance = 0.0;  // m, > 0, radial
  double viscosity = 0.0;  // Pa s, > 0
  bool cavitation = true;  // the film cannot carry tension
};
struct BallSupport {
  int balls = 0;           // >= 3
  double stiffness = 0.0;  // N/m^1.5, > 0, of one ball between its two races
  double play = 0.0;       // m, >= 0, radial travel of the ring until the first ball carries load
  double phase = 0.0;      // rad, angle of the first ball from the x axis
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
  Eigen::Vector2d position{0.0, 0.0};  // m, at t = 0, relative to the rest position
  Eigen::Vector2d velocity{0.0, 0.0};  // m/s, at t = 0
  // True if only linear springs and viscous dampers to the base act on the ring and on its spin.
  bool on_springs_alone() const {
    return !mount && !dry_friction && !squeeze_film && !ball_bearing && !(spin && spin->drags());
  }
};

enum class ActuatorKind { kIdeal, kElectromagnet, kTable };  // the force law

// Two axes at 45 degrees, a_1 = (1, 1)/sqrt 2, a_2 = (-1, 1)/sqrt 2.
struct Actuator {
  ActuatorKind kind = ActuatorKind::kIdeal;
  // ideal: the commanded force, limited
  double force_limit = std::numeric_limits<double>::infinity();  // N, > 0, on each axis
  // electromagnet: F(s, i) of bearing/actuator.h on each axis
  double force_constant = 0.0;  // N m^2/A^2, k_m > 0
  double bias_current = 0.0;    // A, i_0 > 0
  double air_gap = 0.0;         // m, s_0 > 0
  double stiffness = 0.0;       // N/m, c >= 0
  // table: F(s, i) of bearing/actuator.h
  std::vector<double> table_position{};  // m, ascending
  std::vector<double> table_current{};   // A, ascending
  std::vector<double> table_force{};     // N, one value per current for each position in turn
  // electromagnet and table
  // A, limit of |i|, at most bias_current or the table's range. 0: that maximum.
  double current_limit = 0.0;
  // The coil's current follows the commanded one with a lag, coil_lag di/dt = i_commanded - i, as
  // far as the limits of |di/dt| and of the amplifier's voltage u allow: L di/dt = u - R i,
  // |u| <= voltage_limit.
  double coil_lag = 0.0;                                                // s, >= 0; 0: no lag
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

// The velocities of rotor and ring that a sampled controller gets: measured, differences of two
// successive position samples, or none.
enum class VelocitySensor { kMeasured, kDifference, kNone };

// The measurements that a sampled controller gets. Noise is the standard deviation of each number,
// independent of all others. A resolution rounds numbers to its multiples. 0: none.
struct Sensors {
  bool rotor = true, stator = true, spin = true, current = true;  // which quantities are measured
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

// Conditions that switch a sampled controller on, checked from Controller::on. The first one that
// is met counts.
struct Trigger {
  std::optional<double> gap;  // m, > 0: the gap is at most this
  // s, > 0: at its present rate the gap closes within this time.
  std::optional<double> time_to_touch;
  bool touch = false;  // rotor and ring have touched
};

enum class BoundaryLayer { kConstant, kAdaptive };  // width of the sliding mode's boundary layer

struct Controller {  // the control law of the ring
  ControllerKind kind = ControllerKind::kPassive;
  double on = 0.0;           // s, switch-on time, or the time from which a trigger is checked
  double sample_time = 0.0;  // s, >= 0; 0: continuous
  Sensors sensors;
  std::optional<Trigger> trigger;
  // library
  std::string library;              // path of the file, absolute or relative to the scene's
  std::vector<ConfigEntry> config;  // passed to the library
  // sliding mode with boundary layer (22)-(29), tracking q_fd = r_rotor - (delta_0 - g_d) e_r
  double bandwidth = 1500.0;                       // 1/s, psi, > 0
  double boundary_layer = 0.03;                    // m/s, phi, > 0
  BoundaryLayer layer = BoundaryLayer::kConstant;  // adaptive: (27), phi' + psi phi = k
  double switching_gain = 120.0;  // m/s^2, k, >= 0: bound on the unknown acceleration
  double gap_time = 0.008;        // s, > 0, in which the gap reference g_d falls smoothly to 0
  // Normal force of the lasting contact once the gap reference is 0. With 0 the two only graze.
  double preload = 20.0;    // N, >= 0
  double mass_error = 0.0;  // 1, > -1, relative error of the law's ring mass; > 0: too heavy
  // Sampled laws average the feed-forward over this time, in the frame of the whirl. Default: one
  // revolution of the spin.
  std::optional<double> filter_time;  // s, >= 0
  // They also damp the ring's velocity about its mean in that frame. Default: critical damping
  // of the ring.
  std::optional<double> tracking_damping;  // N s/m, >= 0
  // passive: extra spring and damper emulated by the actuator; pd: gains of the tracking error
  double stiffness = 0.0;  // N/m, >= 0
  double damping = 0.0;    // N s/m, >= 0
  // cross_coupled, two_phase: k(Omega), a single value or one for each speed
  std::vector<double> feedback;        // N s/m, >= 0
  std::vector<double> feedback_speed;  // rad/s, >= 0, ascending
  double handover_time = 0.005;  // s, > 0, two_phase: the tracking force fades out over this time
  // lqr, lqg: allowed magnitudes, all > 0
  double allowed_error = 1e-4;   // m, of the rotor's distance from the ring's centre
  double allowed_travel = 1e-3;  // m, of the ring
  double allowed_force = 100.0;  // N
  // lqg: standard deviations, > 0
  double disturbance = 10.0;        // N, of the forces on rotor and ring at the contact
  double measurement_error = 1e-6;  // m, of the measured positions
};

// ---------------------------------------------------------------- [[contact]]
// One auxiliary bearing: its contact, its ring and what acts on the ring.
struct AuxiliaryBearing {
  std::string name{};  // unique; empty: its number, from 1
  std::optional<Contact> contact;
  std::optional<Stator> stator;
  std::optional<Actuator> actuator;
  std::optional<Controller> controller;
};

}  // namespace rotorub::scene
