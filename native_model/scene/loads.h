// [[force]], [gravity] and [base] of a scene (scene.h).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "native_model/scene/auxiliary_bearing.h"
#include "native_model/scene/magnetic_bearing.h"

namespace rotorub::scene {

// How a force varies in time; its formulas are at Force.
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

// Acceleration in the plane of the bending modes. Modal form: `participation` is the load of each
// mode per unit acceleration (kg), default the modal mass.
struct Gravity {
  Eigen::Vector2d acceleration{0.0, 0.0};  // m/s^2
  std::vector<double> participation;       // kg
};

// How bearings, rings and actuators are accelerated: model/base_motion.h.
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

}  // namespace rotorub::scene
