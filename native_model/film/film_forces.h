// Forces of the oil film of a plain journal bearing, by Reynolds' equation for a full, aligned
// bearing of constant viscosity:
//
//   d/dt (H^3 dP/dt) + (D/L)^2 H^3 d^2P/dz^2 = dH/dt + (2 / Omega) (e' cos t + e phi' sin t)
//
// t is the angle from the widest gap in the direction of rotation, H = 1 + e cos t the gap divided
// by the radial clearance c, z the axial coordinate divided by half the length L, with P = 0 at
// z = 1 and -1, and the pressure is 6 mu Omega (R / c)^2 P. The film begins at the widest gap,
// where the oil enters, and carries no tension.
//
// The force on the journal is mu Omega R L (R / c)^2 f, with the components r in the direction of
// the displacement, towards the narrowest gap, and t in the direction of rotation:
//   f = f(e) (1 - 2 phi' / Omega) + d(e) e' / Omega.
#pragma once

namespace rotorub {

struct FilmForces {
  double r = 0.0, t = 0.0;                  // f(e); r < 0 < t
  double slope_r = 0.0, slope_t = 0.0;      // df / de
  double damping_r = 0.0, damping_t = 0.0;  // d(e)
};

// Both: length / diameter > 0, eccentricity e in (0, 1).

// Ocvirk's solution for a short bearing (1952), without the first term of the equation: pressure on
// the half t < pi alone.
FilmForces short_film(double length_to_diameter, double eccentricity);

// The whole equation. The film ends where pressure and its gradient vanish (Reynolds' condition),
// which is the complementarity problem P >= 0. Finite volumes along t, which are uniform in
// Sommerfeld's variable, and one polynomial of degree 8 along half the length.
FilmForces finite_film(double length_to_diameter, double eccentricity);

}  // namespace rotorub
