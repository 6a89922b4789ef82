// Coefficients of a plain journal bearing over the speed, from its dimensions and its load.
#pragma once

#include <array>
#include <numbers>
#include <vector>

namespace rotorub {

// Reynolds' equation of the finite length, or Ocvirk's solution for short bearings
// (film_forces.h).
enum class FilmTheory { kFinite, kShort };

// A full cylindrical bearing, aligned, with oil of constant viscosity. All dimensions > 0.
struct JournalBearing {
  double diameter = 0.0;                        // m, of the journal
  double length = 0.0;                          // m, axial
  double clearance = 0.0;                       // m, radial
  double viscosity = 0.0;                       // Pa s
  double load = 0.0;                            // N, static force of the journal on the film
  double load_angle = -0.5 * std::numbers::pi;  // rad, direction of the load from x; default: -y
  FilmTheory theory = FilmTheory::kFinite;

  bool sound() const {
    return diameter > 0.0 && length > 0.0 && clearance > 0.0 && viscosity > 0.0 && load > 0.0;
  }
};

// The journal at rest in its film, under the load at one speed.
struct FilmPoint {
  double speed = 0.0;         // rad/s, about +z if > 0
  double eccentricity = 0.0;  // distance from the bearing's centre / clearance, in (0, 1)
  double attitude = 0.0;  // rad, > 0: from the load to the displacement, in the sense of rotation
  // k_xx, k_xy, k_yx, k_yy in N/m, then the same for c in N s/m:
  // F = -K dr - C dr' for a small displacement dr from this point.
  std::array<double, 8> coefficients{};
};

// The point with this eccentricity; `sense`: of the rotation, 1 or -1.
FilmPoint film_point(const JournalBearing& bearing, double eccentricity, double sense = 1.0);

// The points from the eccentricity 0.01 to 0.9 in both senses of rotation, by ascending speed, and
// those at the speeds `exact` (rad/s) that lie between. Interpolated, the coefficients are off by
// up to 0.3 % of the largest stiffness or damping: a finite film's damping jumps by a thousandth
// from one volume to the next (film_forces.h), and the interpolation alone is better than 0.05 %.
std::vector<FilmPoint> film_points(const JournalBearing& bearing, std::vector<double> exact = {});

}  // namespace rotorub
