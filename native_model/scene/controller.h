// [controller] of the scene: the law, what it is shown, and what switches it on. SI units.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rotorub::scene {

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

// One entry of [controller.config].
struct ConfigEntry {
  std::string key;
  std::optional<std::string> text;  // absent: a number
  double number = 0.0;
};

enum class BoundaryLayer { kConstant, kAdaptive };

struct Controller {
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

}  // namespace rotorub::scene
