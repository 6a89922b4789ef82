// Shafts with known whirl.
#pragma once

#include <array>

#include "native_model/scene/scene.h"

namespace rotorub::oracle {

// Published: the rotor of Friswell, Penny, Garvey, Lees, "Dynamics of Rotating Machines", example
// 5.9.1: two discs on a uniform shaft between two isotropic bearings. The values are those of the
// converged Euler-Bernoulli beam with rotary inertia, to the given digits. (The book's own 86.66,
// 274.31, 716.78 are for a Timoshenko beam with 6 elements.)
//
// Undamped, with three bending modes kept.
scene::RotorGeometry friswell_rotor();
scene::Scene friswell_scene();  // with this rotor at 100 rad/s

// rad/s, planar modes at rest.
inline constexpr std::array kFriswellAtRest{86.714, 274.743, 716.953};
// rad/s at 4000 rpm, by rising absolute value; backward whirl negative.
inline constexpr std::array kFriswellAt4000Rpm{-85.442, 87.855,   -252.105,
                                               295.292, -600.439, 827.42};
// rad/s, first elastic torsion mode of the free rotor.
inline constexpr double kFriswellTorsion = 650.407;

// Published: `rotor_example` of ROSS (github.com/petrobras/ross), two discs on a shaft of 1.5 m in
// anisotropic bearings. ROSS's elements include shear, ours do not. According to finite elements
// that are independent of both (cubic, 6 and 48 of them), shear lowers the first two frequencies of
// this rotor by 0.055 and 0.060 %, and 6 elements instead of 48 raise them by 1e-6.
//
// Undamped, with `modes` bending modes kept.
scene::RotorGeometry ross_rotor(int modes);

// rad/s at rest, as printed in the documentation of its run_modal.
inline constexpr std::array kRossAtRest{91.79655318, 96.28899977};
// rad/s, from the 48 elements without shear: at rest, and at 100 rad/s, ascending.
inline constexpr std::array kUnshearedRossAtRest{91.84910011612376, 96.34979187194821,
                                                 274.9098408794061, 296.94572351643455};
inline constexpr std::array kUnshearedRossAt100{91.83928941144944, 96.35685378683472,
                                                274.40120718422025, 297.443042039183};

// Exact: a uniform spinning Rayleigh shaft (bending with rotary inertia and gyroscopic moments) on
// two rigid pins. With lambda = n pi / L, r^2 = I / A:
//
//   (1 + r^2 lambda^2) w^2 - 2 Omega r^2 lambda^2 w - (E I / (rho A)) lambda^4 = 0
//
// The positive root is forward whirl, the negative one backward whirl.
struct RayleighShaft {
  double length;          // m
  double diameter;        // m, outer
  double inner_diameter;  // m
  double E;               // Pa
  double rho;             // kg/m^3

  double area() const;     // m^2
  double inertia() const;  // m^4, I
  // Whirl frequency of mode n >= 1 at the spin speed (rad/s): rad/s, forward > 0, backward < 0.
  double forward(int n, double speed) const;
  double backward(int n, double speed) const;
  // Modal mass of mode n, scaled to 1 at its largest deflection: kg.
  double modal_mass(int n) const;
  // Speed at which the forward whirl of mode n is synchronous, rad/s; 0 if there is none (r lambda
  // >= 1).
  double critical_speed(int n) const;
};

}  // namespace rotorub::oracle
