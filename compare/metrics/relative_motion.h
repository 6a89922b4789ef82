// Motion of the rotor's centre relative to the ring's, computed again from the positions and
// velocities of a series, row by row, by code that no engine shares.
#pragma once

#include <numbers>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// d = r_rotor - r_ring in polar form. Where the centres coincide (delta = 0) there is no direction:
// angle, rates and whirl speed are 0.
struct RelativePoint {
  double t = 0.0;            // s
  double delta = 0.0;        // m, |d|, >= 0
  double angle = 0.0;        // rad, of d from the x axis, in (-pi, pi]
  double radial_rate = 0.0;  // m/s, d delta / dt
  double whirl_speed = 0.0;  // m/s, v_t = e_t . ddot, along e_t = e_z x e_r
  double angle_rate = 0.0;   // rad/s, v_t / delta
};

// One point a row, at one of several contacts, from 0. Asserts the columns t, rotor_*, stator_* of
// the contract.
std::vector<RelativePoint> relative_motion(const Trajectory& trajectory, std::size_t contact = 0);

// Rows of `points` (ascending in t) with from <= t <= to: the half-open range of their indices.
struct RowRange {
  std::size_t first = 0, last = 0;
  std::size_t size() const { return last - first; }
};
RowRange rows_between(const std::vector<RelativePoint>& points, double from, double to);

// How far the rows of a range go round, rad. The angle is unwrapped with the help of its rate, so
// that rows may be further apart than half a turn: the whole turns between two rows are those that
// come nearest to the mean of the two rates.
struct Turned {
  double net = 0.0;  // forward (along +z) positive
  double all = 0.0;  // forth and back, >= |net|
  // What the mean of the two rates is off by, mean of its size: pi / 2 where the whole turns are
  // guessed.
  double doubt = 0.0;
};
// From this `doubt` on rows are too far apart to tell the whole turns between them.
inline constexpr double kMostDoubt = 0.25 * std::numbers::pi;

Turned turned_by(const std::vector<RelativePoint>& points, RowRange range);

// Mean whirl frequency d(angle)/dt of these rows, rad/s, forward positive; 0 for fewer than two
// and where the rotor stays in the ring's centre but for round-off (1e-12 m), not a number where it
// cannot be told.
double whirl_frequency(const std::vector<RelativePoint>& points, RowRange range);

}  // namespace rotorub
