// The acceleration of what bearings, rings and actuators stand on ([base]). All coordinates are
// relative to it, so that it loads every mass (equations::add_base_load):
//
//   a_b(t) = e(t) (table(t) + d sum_j A_j cos(w_j t + phi_j)),
//
// e the envelope of `on`, `off` and `ramp`, d the unit vector of `direction`; the table is linear
// between its samples and 0 outside.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "native_model/scene/loads.h"

namespace rotorub {

class BaseMotion {
 public:
  explicit BaseMotion(const scene::Base& base);

  Eigen::Vector2d at(double t) const;  // a_b, m/s^2
  // Over from < to, s; what a fixed step takes. Exact of a table, of a line to (w h)^4 / 4320.
  Eigen::Vector2d mean(double from, double to) const;
  // Instants between which it is smooth, ascending; and those of them at which it may jump.
  const std::vector<double>& breaks() const { return breaks_; }
  const std::vector<double>& jumps() const { return jumps_; }

 private:
  Eigen::Vector2d of_table(double t) const;

  scene::Base base_;  // with the phases that a seed gives
  Eigen::Vector2d direction_;
  std::vector<double> breaks_, jumps_;
};

}  // namespace rotorub
