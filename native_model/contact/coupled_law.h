// Several planar contacts that act on the same bodies, as one problem. With L the normal and
// friction impulses (or forces) of all, (L_N1, L_T1, L_N2, L_T2, ...), and y = a L + b the gap
// rates and slips,
//
//   normal:      L_N >= n,  y_N >= 0,  y_N (L_N - n) = 0
//   tangential:  L_T in [low(L_N), high(L_N)],  y_T > 0: L_T = low,  y_T < 0: L_T = high
//
// each contact i with its own set: n = 0, high = -low = mu L_N is Coulomb's, (12)-(13), (17); the
// expansion of Poisson's law, (18)-(19), is another. A linear complementarity problem (Pfeiffer and
// Glocker, Multibody Dynamics with Unilateral Contacts, 1996). The cases of each contact (open,
// sticking, sliding either way) are tried: given the cases it is a linear system, and what it gives
// must be in the sets.
//
// Impulses that bodies share in more ways than one (two rings about a rotor that cannot tilt) are
// not unique, though the motion is: then those of the least sum of squares, which share alike.
#pragma once

#include <Eigen/Core>

#include <array>
#include <span>

#include "native_model/contact/impact.h"
#include "native_model/contact/most_contacts.h"

namespace rotorub {

// (normal, friction) of each contact in turn; with disc_law.h (normal, friction, friction along the
// axis). No memory but their own.
using ContactVector =
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 3 * kMaxContacts, 1>;
using ContactMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                    3 * kMaxContacts, 3 * kMaxContacts>;

struct CoupledSolution {
  // Of distinct motions; 0: none (or none was found, of more than kMostTried contacts), above 1: L
  // is the first.
  int solutions = 0;
  ContactVector p, y;                       // L, and a L + b
  std::array<bool, kMaxContacts> sticks{};  // y_T = 0 within the set
};

// matrix x = right; the least squares where the matrix is singular.
ContactVector shared_solution(const ContactMatrix& matrix, const ContactVector& right);

// Impulses whose cases are known: L = given + C z, with z so that R^T (a L + b) = 0. Each column of
// C is what one unknown brings along, that of R the rate that is then 0.
struct CaseSystem {
  ContactMatrix columns, rows;  // C, R: the first `count` columns
  ContactVector given;
  Eigen::Index count = 0;

  explicit CaseSystem(Eigen::Index n)
      : columns(ContactMatrix::Zero(n, n)), rows(columns), given(ContactVector::Zero(n)) {}
  // L_row is unknown, y_row = 0. `bring`(row, factor): so much of it beside.
  void free(Eigen::Index row) {
    columns(row, count) = rows(row, count) = 1.0;
    ++count;
  }
  void bring(Eigen::Index row, double factor) { columns(row, count - 1) = factor; }
  ContactVector solve(const ContactMatrix& a, const ContactVector& b) const;
};

// a: symmetric, positive semidefinite, of 2 x sets.size() rows; at most kMaxContacts sets.
CoupledSolution solve_coupled(const ContactMatrix& a, const ContactVector& b,
                              std::span<const ContactSet> sets);

// Coulomb's law of all contacts; with two numbers of each in b, planar, with three, disc_law.h's.
CoupledSolution solve_compression(const ContactMatrix& a, const ContactVector& b,
                                  std::span<const ImpactLaw> laws);
// Coulomb's law over a step, (12)-(13), with mu of the slips at its end. before: m/s, the slips
// where the step begins, one for each contact.
CoupledSolution solve_lasting(const ContactMatrix& a, const ContactVector& b,
                              std::span<const ImpactLaw> laws, std::span<const double> before);
// The expansion alone, after a compression with the impulses `compressed`; b: rates after that.
CoupledSolution solve_expansion(const ContactMatrix& a, const ContactVector& b,
                                std::span<const ImpactLaw> laws, const ContactVector& compressed);
// Compression and expansion, one after the other, of all at a time, in no time. b: rates before.
// p: the sum of both.
CoupledSolution solve_coupled_impact(const ContactMatrix& a, const ContactVector& b,
                                     std::span<const ImpactLaw> laws);

}  // namespace rotorub
