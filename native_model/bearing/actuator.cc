#include "native_model/bearing/actuator.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unsupported/Eigen/Splines>

#include "native_model/numerics/root.h"

namespace rotorub {
namespace {

// The cubic spline through the columns of `points`, with parameters `at` mapped to [0, 1].
using Curve = Eigen::Spline<double, Eigen::Dynamic, 3>;
Curve through(const Eigen::MatrixXd& points, const std::vector<double>& at) {
  Curve::KnotVectorType parameters(static_cast<Eigen::Index>(at.size()));
  for (std::size_t k = 0; k < at.size(); ++k) {
    parameters[static_cast<Eigen::Index>(k)] = (at[k] - at.front()) / (at.back() - at.front());
  }
  return Eigen::SplineFitting<Curve>::Interpolate(points, 3, parameters);
}

using Basis = Eigen::Spline<double, 1, 3>;
// The four cubic B-splines of an axis that are nonzero at x. Returns the index of the first.
template <class Axis>
Eigen::Index basis(const Axis& axis, double x, Basis::BasisVectorType& values) {
  const double u = std::clamp((x - axis.first) / (axis.last - axis.first), 0.0, 1.0);
  values = Basis::BasisFunctions(u, 3, axis.knots);
  return Basis::Span(u, 3, axis.knots) - 3;
}

}  // namespace

double Electromagnet::force(double s, double i) const {
  return magnets_.force(s, i) - stiffness_ * s;
}

double Electromagnet::gain(double s, double i) const {
  const OpposedMagnets::Gaps g = magnets_.gaps(s);
  return magnets_.force_constant *
         (2.0 * magnets_.bias_current * (g.pulling + g.opposing) + i * (g.pulling - g.opposing));
}

// With A, B = 1/(s_0 -+ s)^2 and y = (F + c s)/k_m, i is the root that rises with y of
//   (A - B) i^2 + 2 i_0 (A + B) i + (A - B) i_0^2 - y = 0,
// written without cancellation.
double Electromagnet::current(double s, double force, double limit) const {
  const OpposedMagnets::Gaps g = magnets_.gaps(s);
  const double i0 = magnets_.bias_current, sum = g.pulling + g.opposing;
  const double difference = g.pulling - g.opposing;
  const double y = (force + stiffness_ * s) / magnets_.force_constant;
  const double square = 4.0 * i0 * i0 * g.pulling * g.opposing + difference * y;
  if (!(square > 0.0)) return std::copysign(limit, y);  // no current yields this force
  const double i = (y - difference * i0 * i0) / (i0 * sum + std::sqrt(square));
  return std::clamp(i, -limit, limit);
}

ForceTable::ForceTable(const ForceGrid& grid) : nodes_s_(grid.position), nodes_i_(grid.current) {
  const auto rows = static_cast<Eigen::Index>(grid.position.size());
  const auto columns = static_cast<Eigen::Index>(grid.current.size());
  // A spline over the positions, whose points are the forces at all currents, and then a spline
  // over the currents through its control points.
  const Eigen::Map<const Eigen::MatrixXd> forces(grid.force.data(), columns, rows);
  const Curve over_position = through(forces, grid.position);
  const Curve over_current = through(over_position.ctrls().matrix().transpose(), grid.current);
  control_ = over_current.ctrls();
  position_ = {grid.position.front(), grid.position.back(), over_position.knots()};
  current_ = {grid.current.front(), grid.current.back(), over_current.knots()};
}

double ForceTable::force(double s, double i) const {
  Basis::BasisVectorType over_s, over_i;
  const Eigen::Index row = basis(position_, s, over_s), column = basis(current_, i, over_i);
  double sum = 0.0;
  for (Eigen::Index a = 0; a < 4; ++a) {
    for (Eigen::Index b = 0; b < 4; ++b)
      sum += over_s[a] * over_i[b] * control_(row + a, column + b);
  }
  return sum;
}

double ForceTable::gain(double s, double i) const {
  const double least = 1e-6 * current_.last;
  const double at = std::abs(i) < least ? std::copysign(least, i) : i;
  return (force(s, at) - force(s, 0.0)) / at;
}

// F rises with i, so that there is at most one root between the limits.
double ForceTable::current(double s, double wanted, double limit) const {
  const double low = std::max(-limit, current_.first), high = std::min(limit, current_.last);
  const auto excess = [&](double i) { return force(s, i) - wanted; };
  const double below = excess(low), above = excess(high);
  if (below >= 0.0) return low;
  if (above <= 0.0) return high;
  constexpr double kClose = 1e-15;  // relative to the range
  const auto [a, b] = root(excess, low, high, below, above, kClose * (high - low));
  return 0.5 * (a + b);
}

std::string ForceTable::refusal() const {
  constexpr int kParts = 8;  // test points per interval of the grid
  const auto refined = [](const std::vector<double>& nodes) {
    std::vector<double> all;
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
      for (int part = 0; part < kParts; ++part) {
        all.push_back(nodes[k] + (nodes[k + 1] - nodes[k]) * part / kParts);
      }
    }
    all.push_back(nodes.back());
    return all;
  };
  const std::vector<double> currents = refined(nodes_i_);
  for (const double s : refined(nodes_s_)) {
    for (std::size_t k = 0; k + 1 < currents.size(); ++k) {
      if (force(s, currents[k + 1]) > force(s, currents[k])) continue;
      char text[160];
      std::snprintf(text, sizeof text,
                    "the spline through the values does not rise with the current at s = %g m, i = "
                    "%g A; expected a force that does",
                    s, currents[k]);
      return text;
    }
  }
  return {};
}

}  // namespace rotorub
