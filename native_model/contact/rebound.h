// What follows an impact: flight, or lasting contact. Decided once, for every engine.
//
// Loads and the circle's curvature press with a = -gddot_N, so that the flight after a rebound of
// the speed v lasts 2 v / a. A flight that is over too soon does not count: the impact has
// restitution 0, and contact lasts. An accumulation of impacts ends so. Too soon is
// - before the impact itself is, of one that takes time;
// - within a fixed step, of an impact that is located in its step;
// - within two, where it is not: the step's end then tells its speed with up to the fall of a whole
// step, a h.
//   Then bounces of v = eps_N v + a h keep themselves going for ever: an impact that takes no
//   more than that from its speed has no restitution either (but for long flights, and without any
//   loss there is no accumulation).
#pragma once

#include <Eigen/Core>

namespace rotorub {

// m/s^2, a, of the relative velocity (ddot, contact spin) and the loads' acceleration of the same,
// along the outward normal e_r of a circle of radius delta (m): what turning of the normal adds is
// (e_t . ddot)^2 / delta.
inline double pressing(const Eigen::Vector2d& e_r, const Eigen::Vector3d& velocity,
                       const Eigen::Vector3d& acceleration, double delta) {
  const double whirl = e_r.x() * velocity.y() - e_r.y() * velocity.x();
  return e_r.dot(acceleration.head<2>()) + whirl * whirl / delta;
}

// Whether a flight that begins with `speed` (m/s, of the gap) under `pressed` (m/s^2, a) outlives
// `time` (s).
inline bool flight_outlives(double time, double speed, double pressed) {
  return 2.0 * speed > pressed * time;
}

// Of an impact that is not located in its step, h (s), with the speed `approach` (m/s).
inline bool rebound_outlives_steps(double h, double restitution, double approach, double pressed) {
  constexpr double kLeastSteps = 2.0, kMostSteps = 40.0;
  const double rebound = restitution * approach;
  if (!flight_outlives(kLeastSteps * h, rebound, pressed)) return false;
  const bool feeds_itself = restitution < 1.0 && (1.0 - restitution) * approach <= pressed * h;
  return !feeds_itself || flight_outlives(kMostSteps * h, rebound, pressed);
}

// eps_N of an impact that takes time, at the speed `approach` (m/s) beside loads that press with
// `load` (m/s^2). Poisson's law returns a share of what the loads compress too: v' = eps_N (v + a
// tau_C) - a tau_E, after the flight v'' = sqrt(v'^2 + 2 a tau_E v'), which above some eps_N has a
// fixed point: impacts without end. So where the loads give back more than half of what restitution
// takes, v'' > (1 + eps_N) v / 2, the approach's share alone is returned, eps_N v / (v + a tau_C):
// the impacts fall off with eps_N, and contact comes to rest.
double restitution_beside_loads(double restitution, double approach, double load,
                                double compression_time, double expansion_time);

}  // namespace rotorub
