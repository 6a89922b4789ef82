// The matrix of MuJoCo's step, tree by tree.
//
// M and a diagonal = L^T D L of single kinematic trees: M is of blocks, one a tree, and the degrees
// of freedom of a tree follow each other. What is not in the trees of rotor and ring costs nothing.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>

#include "plugin/model/mujoco_dynamics.h"

namespace rotorub::plugin {

// Degrees of freedom first <= i < last.
struct DofRange {
  int first = 0, last = 0;
};

// Those of the tree that the body is in; empty for what is fixed to the world.
DofRange tree_of(const mjModel* m, int body);

// The sums of MuJoCo's sparse factorisation (mj_factorM), of the rows of `range`. factor: as
// the mass (mass_size), inverse: nv, 1 / D. added(dof): what the diagonal has more.
template <typename Added>
void factor_tree(const mjModel* m, const mjtNum* mass, Added added, DofRange range, mjtNum* factor,
                 mjtNum* inverse) {
  for (int i = range.first; i < range.last; ++i) {
    const MassRow row = mass_row(m, i);
    const int first = row.step > 0 ? row.diagonal : row.diagonal - row.ancestors;
    std::copy_n(mass + first, row.ancestors + 1, factor + first);
    factor[row.diagonal] += added(i);
  }
  // From the tips to the root: each row is taken from those of its ancestors.
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

// x <- (L^T D L)^-1 x, in place, of the entries of `range`.
void solve_tree(const mjModel* m, const mjtNum* factor, const mjtNum* inverse, DofRange range,
                mjtNum* x);

// The matrix H of MuJoCo's step, v' = v + h H^-1 f, block by block of the kinematic trees:
//   dampers explicit (RK4, or disabled)   M
//   Euler                                 M + h B,      B the joints' dampers
//   implicit, implicitfast                M - h dF/dv,  F(v) actuators, dampers of joints and
//                                         tendons, fluid, bias forces: MuJoCo's own derivative,
//                                         which need not be symmetric
// An impulse that is to meet the contact laws at the end of the step has to pass through it.
class StepMatrix {
 public:
  // After mj_fwdActuation. Finds dF/dv, once for all contacts of the pass.
  StepMatrix(const mjModel* m, mjData* d);

  // False: H is M in this tree.
  bool differs(DofRange tree) const;
  // row <- row H^-1 of the entries of the tree, of `rows` rows of nv.
  void solve(DofRange tree, mjtNum* row, int rows) const;
  // to += (H - M) x of the entries of the tree.
  void add_excess(DofRange tree, const mjtNum* x, mjtNum* to) const;

 private:
  void fill_excess(DofRange tree, mjtNum* block) const;

  const mjModel* m_;
  mjData* d_;
  bool implicit_;
  double damped_step_;  // s, of explicit integrators: the h of M + h B
};

}  // namespace rotorub::plugin
