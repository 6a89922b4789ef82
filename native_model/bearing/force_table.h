// F(s, i) of a magnetic actuator from measured or computed values on a grid, by a bicubic spline
// that goes through them. Beyond the grid the value at its edge is held.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <unsupported/Eigen/Splines>

#include "native_model/bearing/force_law.h"

namespace rotorub {

struct ForceGrid {
  std::vector<double> position;  // m, ascending, kLeast or more
  std::vector<double> current;   // A, ascending, kLeast or more, from below 0 to above 0
  std::vector<double> force;     // N, position by position, one for each current; rising with it
  static constexpr std::size_t kLeast = 4;  // of a cubic
};

class ForceTable final : public ForceLaw {
 public:
  // The grid is in order (scene validation); ask refusal() before inverting.
  explicit ForceTable(const ForceGrid& grid);

  double force(double s, double i) const override;
  double gain(double s, double i) const override;
  double current(double s, double force, double limit) const override;

  // Empty, or why the spline has no inverse: where between the points it falls with the current.
  std::string refusal() const;

 private:
  using Spline = Eigen::Spline<double, 1, 3>;
  // Cubic B-splines over one side of the grid, its values mapped to [0, 1].
  struct Axis {
    double first = 0.0, last = 1.0;
    Spline::KnotVectorType knots;
    // The four functions that are not 0 at x, and the place of the first.
    Eigen::Index basis(double x, Spline::BasisVectorType& values) const;
  };

  Axis position_, current_;
  std::vector<double> nodes_s_, nodes_i_;
  Eigen::MatrixXd control_;  // points, position x current
};

}  // namespace rotorub
