// Exact: free flights between impacts.
#pragma once

#include <Eigen/Core>

namespace rotorub::oracle {

// A point (relative centre) flying freely in a circle of radius delta_0 with lossless, frictionless
// reflections. Chords last 2 delta_0 cos(beta) / v, the impact angle advances by pi - 2 beta, beta
// the angle of incidence from the normal.
class Billiard {
 public:
  // clearance: m, > 0. Start inside the circle, velocity not zero.
  Billiard(double clearance, const Eigen::Vector2d& position, const Eigen::Vector2d& velocity);

  double first_impact() const { return first_; }     // s
  double chord_time() const { return chord_time_; }  // s, between impacts
  int impacts_until(double t) const;                 // impacts in (0, t]
  Eigen::Vector2d position(double t) const;          // m
  Eigen::Vector2d velocity(double t) const;          // m/s

 private:
  struct Flight {
    double since;
    Eigen::Vector2d from, velocity;
  };
  Flight flight(double t) const;

  double clearance_, speed_, first_ = 0.0, chord_time_ = 0.0, advance_ = 0.0;
  Eigen::Vector2d start_, start_velocity_;
  double first_angle_ = 0.0, beta_ = 0.0;  // rad; beta signed by the angular momentum
};

// A body under constant acceleration g falls the height h onto the ring and bounces with
// the restitution eps < 1: impacts at sqrt(2h/g) (1 + 2 eps + 2 eps^2 + ... + 2 eps^k), rest at
// sqrt(2h/g) (1 + eps) / (1 - eps).
struct Drop {
  double height;       // m, > 0
  double gravity;      // m/s^2, > 0
  double restitution;  // eps_N in [0, 1)

  double fall_time() const;             // s, sqrt(2h/g)
  double impact_time(int index) const;  // s, index from 0
  double rest_time() const;             // s
  double height_at(double t) const;     // m, above the ring
};

}  // namespace rotorub::oracle
