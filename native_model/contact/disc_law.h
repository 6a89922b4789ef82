// Contacts whose friction acts in both directions of the tangent plane. L = (L_N, L_1, L_2) of each
// contact in turn, impulses or forces, y = a L + b the gap rates and the slips along the ring's
// circle and its axis:
//
//   normal:      L_N >= n,  y_N >= 0,  y_N (L_N - n) = 0
//   tangential:  L_T in C,  y_T . (x - L_T) >= 0 for every x in C: the most is dissipated
//                C = { |L_T| <= mu L_N,  side . L_T >= floor }
//
// n = 0 and no side: Coulomb's law, (12)-(13), (17), with its disc; what slides has L_T = -mu L_N
// y_T / |y_T|. The expansion of Poisson's law, (18)-(19), has n = eps_N L_NC and for side the
// direction of the friction of the compression, floor = eps_N eps_T |L_TC|: in one direction C is
// the interval of impact.h.
//
// One contact is solved in closed form by cases. Friction on the disc's rim against the slip's
// direction d, |d| = 1, makes y_T parallel to d: a quartic of tan(angle / 2), of which every real
// root is tried. Several contacts are solved in turn until none changes (projected Gauss-Seidel),
// with the linear system of the cases found so far in between; its solution of least squares shares
// what bodies share in more ways than one.
#pragma once

#include <Eigen/Core>

#include <span>

#include "native_model/contact/coupled_law.h"
#include "native_model/contact/single_disc.h"

namespace rotorub {

// Of the expansion that follows a compression of L_NC, L_TC, with this mu.
DiscSet expansion_disc(const ImpactLaw& law, double mu, double normal,
                       const Eigen::Vector2d& friction);

// a: symmetric, positive semidefinite, of 3 x sets.size() rows; at most kMaxContacts sets. A
// tangential direction in which nothing moves has rows of 0. The number of distinct solutions is
// reported for one contact alone; of several 0: none was found to round-off.
CoupledSolution solve_discs(const ContactMatrix& a, const ContactVector& b,
                            std::span<const DiscSet> sets);

}  // namespace rotorub
