// Contacts with friction in both directions of the tangent plane. L = (L_N, L_1, L_2) of each
// contact in turn holds impulses or forces, and y = a L + b holds the gap rates and the slips along
// the circle of the ring and along its axis:
//
//   normal:      L_N >= n,  y_N >= 0,  y_N (L_N - n) = 0
//   tangential:  L_T in C,  y_T . (x - L_T) >= 0 for every x in C (maximal dissipation)
//                C = { |L_T| <= mu L_N,  side . L_T >= floor }
//
// With n = 0 and no side this is Coulomb's law, (12)-(13), (17), with its disc: a sliding contact
// has L_T = -mu L_N y_T / |y_T|. The expansion of Poisson's law, (18)-(19), has n = eps_N L_NC, the
// direction of the compression's friction as side, and floor = eps_N eps_T |L_TC|. In one direction
// C is the interval of impact.h.
//
// One contact is solved in closed form by cases. Friction on the rim of the disc, opposite to a
// direction d with |d| = 1, requires y_T parallel to d. This is a quartic in tan(angle / 2), and
// every real root is tried. Several contacts are solved in turn until none changes (projected
// Gauss-Seidel). In between, the linear system of the cases found so far is tried; its
// least-squares solution distributes impulses that the bodies can share in several ways.
#pragma once

#include <Eigen/Core>

#include <span>

#include "native_model/contact/coupled_problem.h"
#include "native_model/contact/single_disc.h"

namespace rotorub {

// The set of the expansion after a compression with the impulses L_NC, L_TC.
DiscSet expansion_disc(const ImpactLaw& law, double mu, double normal,
                       const Eigen::Vector2d& friction);

// a: symmetric, positive semidefinite, with 3 x sets.size() rows; at most kMaxContacts sets. The
// rows of a tangential direction without motion are 0. Distinct solutions are counted only for a
// single contact; for several contacts 0 means that none was found to round-off.
CoupledSolution solve_discs(const ContactMatrix& a, const ContactVector& b,
                            std::span<const DiscSet> sets);

}  // namespace rotorub
