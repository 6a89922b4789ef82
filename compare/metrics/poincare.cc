#include "compare/metrics/poincare.h"

#include <cmath>
#include <numbers>

namespace rotorub {

std::vector<std::complex<double>> poincare_points(const Trajectory& run, double from) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const std::vector<double>&t = run.column("t"), &angle = run.column("spin_angle");
  const std::vector<double>&x = run.column("rotor_x"), &y = run.column("rotor_y");
  std::vector<std::complex<double>> points;
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double before = std::floor(angle[i - 1] / kTurn), after = std::floor(angle[i] / kTurn);
    if (before == after || t[i - 1] < from) continue;
    // The last multiple that is passed: rows stand closer than a turn.
    const double passed = kTurn * (after > before ? after : before);
    const double share = (passed - angle[i - 1]) / (angle[i] - angle[i - 1]);
    points.emplace_back(std::lerp(x[i - 1], x[i], share), std::lerp(y[i - 1], y[i], share));
  }
  return points;
}

}  // namespace rotorub
