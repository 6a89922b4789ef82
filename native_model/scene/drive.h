// [drive] of a scene (scene.h).
#pragma once

#include <limits>
#include <vector>

namespace rotorub::scene {

// The law of the motor's torque.
enum class DriveKind { kFree, kLinear, kKloss, kTable, kSpeedControlled };

struct Drive {  // the motor: its torque as a function of speed and time
  DriveKind kind = DriveKind::kFree;
  double gain = 0.0;                 // linear, speed_controlled: N m s, >= 0; bearing/drive.h
  double speed = 0.0;                // linear, speed_controlled: rad/s
  double breakdown_torque = 0.0;     // kloss: N m, > 0
  double breakdown_slip = 0.0;       // kloss: 1, > 0
  double synchronous_speed = 0.0;    // kloss: rad/s, > 0
  std::vector<double> table_speed;   // table: rad/s, ascending, at least 2
  std::vector<double> table_torque;  // table: N m
  // speed_controlled: PI control of the motor's speed, whose reference goes from rotor.speed to
  // `speed` at the rate `acceleration` (infinity: at once)
  double integral_gain = 0.0;  // N m/rad, >= 0, on the angle that the motor lags behind
  double torque_limit = std::numeric_limits<double>::infinity();  // N m, > 0
  double acceleration = std::numeric_limits<double>::infinity();  // rad/s^2, > 0, of the reference
  double station = 0.0;                                           // m, geometry form
  double inertia = 0.0;  // kg m^2, >= 0, geometry form: of the motor's rotor at `station`
};

}  // namespace rotorub::scene
