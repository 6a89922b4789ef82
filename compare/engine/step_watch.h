// What an onlooker sees of every step of a MuJoCo run.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

namespace rotorub {

// Step k, from t = k h to t + h. MuJoCo's Euler step is leapfrog: its velocities are those of half
// a step before its positions, and a force of the step acts about t, from t - h/2 to t + h/2
// (native_model/stepping/verlet_step.h).
struct WatchedStep {
  double t = 0.0, h = 0.0;  // s
  // The state of t: nq values of the plugin's model (without coils). Velocities are those of t, the
  // mean of those of the half steps beside it: of second order where no impact is between them.
  const double* q = nullptr;
  const double* v = nullptr;
  Eigen::Vector2d current{0.0, 0.0};  // A, of the coils at t
  // The actuator's command (system/actuation.h), and from when it acts, s.
  Eigen::Vector2d command{0.0, 0.0};
  double command_begin = 0.0;
  double normal_impulse = 0.0;  // N s, of the step, >= 0
  bool impact = false;          // that is an impact's, of a rigid law, with
  double impact_time = 0.0;     // s
  double gap_rate_after = 0.0;  // m/s
};
using StepWatch = std::function<void(const WatchedStep&)>;

}  // namespace rotorub
