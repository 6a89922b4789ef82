// Exact: a point (relative centre) flying freely in a circle of radius delta_0 with lossless,
// frictionless reflections. Chords last 2 delta_0 cos(beta) / v, the impact angle advances by
// pi - 2 beta, beta the angle of incidence from the normal.
#pragma once

#include <Eigen/Core>

namespace rotorub::oracle {

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

}  // namespace rotorub::oracle
