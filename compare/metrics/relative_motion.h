// Motion of the rotor's centre relative to the ring's. It is recomputed from the positions and
// velocities of each row of a series, by code that no engine uses.
#pragma once

#include <numbers>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// d = r_rotor - r_ring in polar form. If the centres coincide (delta = 0), the direction is
// undefined, and angle, rates and whirl speed are 0.
struct RelativePoint {
  double t = 0.0;            // s
  double delta = 0.0;        // m, |d|, >= 0
  double angle = 0.0;        // rad, of d from the x axis, in (-pi, pi]
  double radial_rate = 0.0;  // m/s, d delta / dt
  double whirl_speed = 0.0;  // m/s, v_t = e_t . ddot, along e_t = e_z x e_r
  double angle_rate = 0.0;   // rad/s, v_t / delta
};

// One point per row, at the contact with this index. Asserts that the contract's columns t, rotor_*
// and stator_* exist.
std::vector<RelativePoint> relative_motion(const Trajectory& trajectory, std::size_t contact = 0);

// Rows of `points` (ascending in t) with from <= t <= to: the half-open range of their indices.
struct RowRange {
  std::size_t first = 0, last = 0;
  std::size_t size() const { return last - first; }
};
RowRange rows_between(const std::vector<RelativePoint>& points, double from, double to);

// Angle travelled over the rows of a range, rad. The angle is unwrapped using its rate, so that
// rows may be more than half a turn apart: the number of whole turns between two rows is the one
// nearest to their mean rate.
struct Turned {
  double net = 0.0;  // forward (along +z) positive
  double all = 0.0;  // back and forth, >= |net|
  // Mean absolute error of that mean rate's prediction, rad; pi / 2 if the whole turns are guesses.
  double doubt = 0.0;
};
// From this `doubt` on, rows are too far apart to determine the whole turns between them.
inline constexpr double kMostDoubt = 0.25 * std::numbers::pi;

Turned turned_by(const std::vector<RelativePoint>& points, RowRange range);

// Mean whirl frequency d(angle)/dt of these rows, rad/s, forward positive. 0 for fewer than two
// rows, or if the rotor stays at the ring's centre within round-off (1e-12 m); NaN if it cannot be
// determined.
double whirl_frequency(const std::vector<RelativePoint>& points, RowRange range);

}  // namespace rotorub
