// Several planar contacts on the same bodies, solved as one problem. L holds the normal and
// friction impulses (or forces) of all contacts, (L_N1, L_T1, L_N2, L_T2, ...), and y = a L + b
// their gap rates and slips:
//
//   normal:      L_N >= n,  y_N >= 0,  y_N (L_N - n) = 0
//   tangential:  L_T in [low(L_N), high(L_N)],  y_T > 0: L_T = low,  y_T < 0: L_T = high
//
// Each contact has its own set (ContactSet). Coulomb's law, (12)-(13), (17), has n = 0 and high =
// -low = mu L_N; the expansion of Poisson's law, (18)-(19), has another set. This is a linear
// complementarity problem (Pfeiffer and Glocker, Multibody Dynamics with Unilateral Contacts,
// 1996). It is solved by trying the cases of each contact (open, sticking, sliding either way): for
// given cases the problem is a linear system, whose solution must lie in the sets. With more than
// kMostTried contacts only cases that follow from each other are tried, first in rounds over all
// contacts, then in sweeps from contact to contact (projected Gauss-Seidel).
//
// If the bodies can share impulses in several ways (two rings about a rotor that cannot tilt), the
// impulses are not unique, although the motion is. The result then has the least sum of squares,
// which shares the impulses equally.
#pragma once

#include <Eigen/Core>

#include <array>
#include <span>

#include "native_model/contact/contact_list.h"
#include "native_model/contact/impact.h"

namespace rotorub {

// (normal, friction) of each contact in turn, or (normal, friction, axial friction) with
// disc_law.h. These types need no heap memory.
using ContactVector =
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 3 * kMaxContacts, 1>;
using ContactMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                    3 * kMaxContacts, 3 * kMaxContacts>;

struct CoupledSolution {
  // Number of distinct motions. 0: there is none, or none was found for more than kMostTried
  // contacts, and p and y mean nothing; above 1: p and y are the first.
  int solutions = 0;
  bool is_unique() const { return solutions == 1; }
  ContactVector p, y;                       // L, and a L + b
  std::array<bool, kMaxContacts> sticks{};  // y_T = 0 within the set
};

// Solves matrix x = right; the least-squares solution of least norm if the matrix is singular.
ContactVector shared_solution(const ContactMatrix& matrix, const ContactVector& right);

// The impulses for known cases: L = given + C z, with z from R^T (a L + b) = 0. A column of C holds
// the impulses that belong to one unknown; the same column of R selects the rate that is then 0.
struct CaseSystem {
  ContactMatrix columns, rows;  // C, R: the first `count` columns
  ContactVector given;
  Eigen::Index count = 0;

  explicit CaseSystem(Eigen::Index n)
      : columns(ContactMatrix::Zero(n, n)), rows(columns), given(ContactVector::Zero(n)) {}
  // Makes L_row unknown, with y_row = 0. tie(row, factor) then makes L_row depend on this unknown:
  // it adds `factor` times the last unknown to L_row (friction as a multiple of the normal
  // impulse).
  void set_unknown(Eigen::Index row) {
    columns(row, count) = rows(row, count) = 1.0;
    ++count;
  }
  void tie(Eigen::Index row, double factor) { columns(row, count - 1) = factor; }
  ContactVector solve(const ContactMatrix& a, const ContactVector& b) const;
};

// a: symmetric, positive semidefinite, with 2 x sets.size() rows; at most kMaxContacts sets.
CoupledSolution solve_coupled(const ContactMatrix& a, const ContactVector& b,
                              std::span<const ContactSet> sets);

// True if a single contact can move in both directions: its 2 x 2 matrix is not singular.
bool moves_both_ways(const ContactMatrix& a);

}  // namespace rotorub
