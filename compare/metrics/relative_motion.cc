#include "compare/metrics/relative_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "native_model/trajectory/columns.h"

namespace rotorub {
namespace {

constexpr double kNoOrbit = 1e-12;  // m, round-off of a rotor at the ring's centre

RelativePoint polar(double t, double x, double y, double vx, double vy) {
  RelativePoint point;
  point.t = t;
  point.delta = std::hypot(x, y);
  if (point.delta == 0.0) return point;
  point.angle = std::atan2(y, x);
  point.radial_rate = (x * vx + y * vy) / point.delta;
  point.whirl_speed = (x * vy - y * vx) / point.delta;
  point.angle_rate = point.whirl_speed / point.delta;
  return point;
}

}  // namespace

std::vector<RelativePoint> relative_motion(const Trajectory& trajectory, std::size_t contact) {
  const auto column = [&](const char* name) -> const std::vector<double>& {
    return trajectory.column(column_of_contact(contact, name));
  };
  const auto& t = trajectory.column("t");
  const auto& rotor_x = column("rotor_x");
  const auto& rotor_y = column("rotor_y");
  const auto& rotor_vx = column("rotor_vx");
  const auto& rotor_vy = column("rotor_vy");
  const auto& stator_x = column("stator_x");
  const auto& stator_y = column("stator_y");
  const auto& stator_vx = column("stator_vx");
  const auto& stator_vy = column("stator_vy");

  std::vector<RelativePoint> points(t.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    points[i] = polar(t[i], rotor_x[i] - stator_x[i], rotor_y[i] - stator_y[i],
                      rotor_vx[i] - stator_vx[i], rotor_vy[i] - stator_vy[i]);
  }
  return points;
}

RowRange rows_between(const std::vector<RelativePoint>& points, double from, double to) {
  const auto begin = points.begin();
  // Rows at the ends are included, however their times were rounded.
  const double round_off = 1e-12 * std::max(std::abs(from), std::abs(to));
  const auto first = std::lower_bound(begin, points.end(), from - round_off,
                                      [](const RelativePoint& p, double t) { return p.t < t; });
  const auto last = std::upper_bound(first, points.end(), to + round_off,
                                     [](double t, const RelativePoint& p) { return t < p.t; });
  return {static_cast<std::size_t>(first - begin), static_cast<std::size_t>(last - begin)};
}

Turned turned_by(const std::vector<RelativePoint>& points, RowRange range) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  Turned turned;
  for (std::size_t i = range.first + 1; i < range.last; ++i) {
    const RelativePoint& a = points[i - 1];
    const RelativePoint& b = points[i];
    const double expected = 0.5 * (a.angle_rate + b.angle_rate) * (b.t - a.t);
    const double seen = b.angle - a.angle;
    const double angle = seen + kTurn * std::round((expected - seen) / kTurn);
    turned.net += angle;
    turned.all += std::abs(angle);
    turned.doubt += std::abs(angle - expected);
  }
  if (range.size() > 1) turned.doubt /= static_cast<double>(range.size() - 1);
  return turned;
}

double whirl_frequency(const std::vector<RelativePoint>& points, RowRange range) {
  if (range.size() < 2) return 0.0;
  const double span = points[range.last - 1].t - points[range.first].t;
  if (span <= 0.0) return 0.0;
  double largest = 0.0;
  for (std::size_t i = range.first; i < range.last; ++i)
    largest = std::max(largest, points[i].delta);
  if (largest < kNoOrbit) return 0.0;
  const Turned turned = turned_by(points, range);
  return turned.doubt < kMostDoubt ? turned.net / span : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace rotorub
