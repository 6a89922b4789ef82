// Exact: a uniform spinning Rayleigh shaft (bending with rotary inertia and gyroscopic moments) on
// two rigid pins. With lambda = n pi / L, r^2 = I / A:
//
//   (1 + r^2 lambda^2) w^2 - 2 Omega r^2 lambda^2 w - (E I / (rho A)) lambda^4 = 0
//
// The positive root is forward whirl, the negative one backward whirl.
#pragma once

namespace rotorub::oracle {

struct RayleighShaft {
  double length;          // m
  double diameter;        // m, outer
  double inner_diameter;  // m
  double E;               // Pa
  double rho;             // kg/m^3

  double area() const;     // m^2
  double inertia() const;  // m^4, I
  // Whirl of mode n >= 1 at the spin speed (rad/s): rad/s, forward > 0, backward < 0.
  double forward(int n, double speed) const;
  double backward(int n, double speed) const;
  // Modal mass of mode n scaled to 1 at its largest deflection: kg.
  double modal_mass(int n) const;
  // Speed at which forward whirl of mode n is synchronous: rad/s; 0 where it never is
  // (r lambda >= 1).
  double critical_speed(int n) const;
};

}  // namespace rotorub::oracle
