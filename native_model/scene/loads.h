// [[force]], [gravity] and [base] of a scene (scene.h).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "native_model/scene/auxiliary_bearing.h"
#include "native_model/scene/magnetic_bearing.h"

namespace rotorub::scene {

// Time dependence of a force; see Force for the formulas.
enum class ForceKind { kRotating, kConstant, kSynchronous, kChirp, kPulse, kUnbalance };

// A force that acts for on <= t < off and rises linearly from 0 over [on, on + ramp]. The first
// three kinds are amplitude (cos a, sin a):
//   rotating:    a = frequency t + phase, with t the absolute time
//   synchronous: a = phi + phase, with phi the spin angle; external, without torque on the spin
//   chirp:       a' rises linearly in time from `frequency` at `on` to `frequency_end` at `off`;
//                a = phase at `on`
//   constant:    vector
//   pulse:       vector sin(pi (t - on)/(off - on))
//   unbalance:   not an external force but an eccentric mass from `on` onwards (loss of a blade),
//                which acts as the eccentricity of a rotor.disc does
struct Force {
  ForceKind kind = ForceKind::kRotating;
  double amplitude = 0.0;            // N; a negative value shifts the phase by pi
  double frequency = 0.0;            // rad/s, rotating, chirp; negative: backward
  double frequency_end = 0.0;        // rad/s, chirp
  double phase = 0.0;                // rad; unbalance: from the rotor-fixed x axis
  double static_moment = 0.0;        // kg m, >= 0, unbalance: mass times eccentricity
  Eigen::Vector2d vector{0.0, 0.0};  // N, constant, pulse
  double on = 0.0;                   // s
  double off = kNever;               // s
  double ramp = 0.0;                 // s, >= 0
  std::vector<double> shape;         // modal form: mode values at the station, default all 1
  double station = 0.0;              // m, geometry form
};

// Acceleration in the plane of the bending modes. In the modal form, `participation` is the load of
// each mode per unit acceleration (kg); its default is the modal mass.
struct Gravity {
  Eigen::Vector2d acceleration{0.0, 0.0};  // m/s^2
  std::vector<double> participation;       // kg
};

// Acceleration of the base on which bearings, rings and actuators stand; see model/base_motion.h.
struct Base {
  std::vector<double> time;                            // s, ascending, empty or at least 2
  std::vector<double> acceleration_x, acceleration_y;  // m/s^2, at each time; empty: 0
  std::vector<double> frequency, amplitude, phase;     // rad/s >= 0, m/s^2, rad of each line
  std::optional<int> seed;                             // >= 0, generates the phases
  double direction = 0.0;  // rad, direction of the lines from the x axis
  double on = 0.0;         // s
  double off = kNever;     // s
  double ramp = 0.0;       // s, >= 0
};

}  // namespace rotorub::scene
