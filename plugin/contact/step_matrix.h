// The matrix of MuJoCo's step, tree by tree.
//
// M, with terms added to its diagonal, is factored as L^T D L for single kinematic trees. M
// consists of one block for each tree, and the degrees of freedom of a tree are consecutive. Trees
// other than those of rotor and ring cost nothing.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>

#include "plugin/model/mujoco_dynamics.h"

namespace rotorub::plugin {

// Degrees of freedom first <= i < last.
struct DofRange {
  int first = 0, last = 0;
};

// The degrees of freedom of the tree that contains the body; empty if the body is fixed to the
// world.
DofRange tree_of(const mjModel* m, int body);

// MuJoCo's sparse factorisation (mj_factorM) for the rows of `range`. factor: as long as the mass
// matrix (mass_size); inverse: nv, 1 / D. added(dof): what is added to the diagonal.
template <typename Added>
void factor_tree(const mjModel* m, const mjtNum* mass, Added added, DofRange range, mjtNum* factor,
                 mjtNum* inverse) {
  for (int i = range.first; i < range.last; ++i) {
    const MassRow row = mass_row(m, i);
    const int first = row.step > 0 ? row.diagonal : row.diagonal - row.ancestors;
    std::copy_n(mass + first, row.ancestors + 1, factor + first);
    factor[row.diagonal] += added(i);
  }
  // From the tips to the root: each row is subtracted from those of its ancestors.
  for (int k = range.last - 1; k >= range.first; --k) {
    const MassRow row = mass_row(m, k);
    mjtNum* diagonal = factor + row.diagonal;
    inverse[k] = 1.0 / *diagonal;
    mjtNum* of_row = diagonal + row.step;
    int i = m->dof_parentid[k];
    for (int left = row.ancestors; left > 0; --left, of_row += row.step, i = m->dof_parentid[i]) {
      const mjtNum share = *of_row / *diagonal;
      mjtNum* to = factor + mass_row(m, i).diagonal;
      for (int j = 0; j < left; ++j) to[j * row.step] -= of_row[j * row.step] * share;
      *of_row = share;
    }
  }
}

// x <- (L^T D L)^-1 x, in place, for the entries of `range`.
void solve_tree(const mjModel* m, const mjtNum* factor, const mjtNum* inverse, DofRange range,
                mjtNum* x);

// The matrix H of MuJoCo's step, v' = v + h H^-1 f, in one block for each kinematic tree:
//   explicit dampers (RK4, or disabled)   M
//   Euler                                 M + h B,      B: the joints' dampers
//   implicit, implicitfast                M - h dF/dv,  F(v): actuators, dampers of joints and
//                                         tendons, fluid, bias forces; MuJoCo's own derivative,
//                                         which need not be symmetric
// An impulse that must obey the contact laws at the end of the step acts through this matrix.
class StepMatrix {
 public:
  // Make it after mj_fwdActuation. Computes dF/dv once for all contacts of the pass.
  StepMatrix(const mjModel* m, mjData* d);

  // False if H is M in this tree.
  bool differs(DofRange tree) const;
  // row <- row H^-1 for the tree's entries of `rows` rows of length nv.
  void solve(DofRange tree, mjtNum* row, int rows) const;
  // to += (H - M) x for the tree's entries.
  void add_excess(DofRange tree, const mjtNum* x, mjtNum* to) const;

 private:
  void fill_excess(DofRange tree, mjtNum* block) const;

  const mjModel* m_;
  mjData* d_;
  bool implicit_;
  double damped_step_;  // s, the h of M + h B; not used by implicit integrators
};

}  // namespace rotorub::plugin
