// The actuator of a ring. It has two axes at 45 degrees, a_1 = (1, 1)/sqrt 2 and a_2 = (-1, 1)/sqrt
// 2. On each it has the force F(s, i), (2) of the paper, a pure function of the ring's displacement
// s along the axis (m) and the control current i (A).
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "native_model/bearing/opposed_magnets.h"

namespace rotorub {

inline constexpr double kHalfRoot = 0.70710678118654752440;  // 1/sqrt 2

// Components of a vector of the fixed frame along the axes: (a_1 . r, a_2 . r).
inline Eigen::Vector2d to_axes(const Eigen::Vector2d& r) {
  return {kHalfRoot * (r.x() + r.y()), kHalfRoot * (r.y() - r.x())};
}

// The vector s_1 a_1 + s_2 a_2 in the fixed frame.
inline Eigen::Vector2d from_axes(const Eigen::Vector2d& s) {
  return {kHalfRoot * (s.x() - s.y()), kHalfRoot * (s.x() + s.y())};
}

class ForceLaw {
 public:
  virtual ~ForceLaw() = default;
  // N, along the axis. Finite for all finite s and i.
  virtual double force(double s, double i) const = 0;
  // N/A: (F(s, i) - F(s, 0)) / i, or its limit at i = 0.
  virtual double gain(double s, double i) const = 0;
  // Inverse for feedback linearisation: the current (A) within +- limit whose force at s is closest
  // to `force` (N).
  virtual double current(double s, double force, double limit) const = 0;
  // m: |s| at which the ring would enter a core, so that the law ends.
  virtual double reach() const { return std::numeric_limits<double>::infinity(); }
};

// Two opposed electromagnets (opposed_magnets.h) and a spring,
//
//   F(s, i) = k_m [ ((i_0 + i)/(s_0 - s))^2 - ((i_0 - i)/(s_0 + s))^2 ] - c s
class Electromagnet final : public ForceLaw {
 public:
  struct Parameters {
    OpposedMagnets magnets{};
    double stiffness = 0.0;  // N/m, c >= 0
  };
  explicit Electromagnet(const Parameters& p) : magnets_(p.magnets), stiffness_(p.stiffness) {}

  double force(double s, double i) const override;
  double gain(double s, double i) const override;
  double current(double s, double force, double limit) const override;
  double reach() const override { return magnets_.air_gap; }

 private:
  OpposedMagnets magnets_;
  double stiffness_;
};

// F(s, i) of a magnetic actuator from measured or computed values on a grid, interpolated by a
// bicubic spline. Outside the grid the value at its edge is held.
struct ForceGrid {
  std::vector<double> position;  // m, ascending, at least kLeast values
  std::vector<double> current;   // A, ascending, at least kLeast values, from below 0 to above 0
  // N, one value per current for each position in turn; rising with the current
  std::vector<double> force;
  static constexpr std::size_t kLeast = 4;  // needed for a cubic
};

class ForceTable final : public ForceLaw {
 public:
  // The grid must have passed scene validation. Check refusal() before inverting.
  explicit ForceTable(const ForceGrid& grid);

  double force(double s, double i) const override;
  double gain(double s, double i) const override;
  double current(double s, double force, double limit) const override;

  // Empty if the spline can be inverted. Otherwise says where it falls with the current.
  std::string refusal() const;

 private:
  // Cubic B-splines along one side of the grid, whose range is mapped to [0, 1].
  struct Axis {
    double first = 0.0, last = 1.0;
    Eigen::Array<double, 1, Eigen::Dynamic> knots;
  };

  Axis position_, current_;
  std::vector<double> nodes_s_, nodes_i_;
  Eigen::MatrixXd control_;  // control points, position x current
};

}  // namespace rotorub
