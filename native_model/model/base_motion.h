// The acceleration of the base on which bearings, rings and actuators stand ([base]). All
// coordinates are relative to the base, so its acceleration loads every mass
// (equations::add_base_load):
//
//   a_b(t) = e(t) (table(t) + d sum_j A_j cos(w_j t + phi_j)),
//
// where e is the envelope of `on`, `off` and `ramp`, and d the unit vector of `direction`. The
// table is linear between its samples and 0 outside.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "native_model/scene/loads.h"

namespace rotorub {

class BaseMotion {
 public:
  explicit BaseMotion(const scene::Base& base);

  Eigen::Vector2d at(double t) const;  // a_b, m/s^2
  // m/s^2, mean over [from, to], s, from < to; used by fixed-step integrators. It is exact for the
  // table and the ramp; for a cosine the error relative to A_j is at most (w_j h)^4 / 4320.
  Eigen::Vector2d mean(double from, double to) const;
  // s, ascending: times between which the motion is smooth, and the times at which it may jump.
  const std::vector<double>& breaks() const { return breaks_; }
  const std::vector<double>& jumps() const { return jumps_; }

 private:
  Eigen::Vector2d of_table(double t) const;

  scene::Base base_;  // with the phases from the seed, if there is one
  Eigen::Vector2d direction_;
  std::vector<double> breaks_, jumps_;
};

}  // namespace rotorub
