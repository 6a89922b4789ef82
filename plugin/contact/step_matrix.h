// The matrix of MuJoCo's step, for single kinematic trees. The mass matrix M consists of one block
// for each tree, and the degrees of freedom of a tree are consecutive. Only the trees of rotor and
// ring are processed.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {

// Degrees of freedom first <= i < last.
struct DofRange {
  int first = 0, last = 0;
};

// The degrees of freedom of the tree that contains the body; empty if the body is fixed to the
// world.
DofRange tree_of(const mjModel* m, int body);

// The last degree of freedom that moves the body, or -1.
int last_dof(const mjModel* m, int body);

// x <- (L^T D L)^-1 x, in place, for the entries of `range` of three vectors of length nv, which
// follow one another. factor: L and D in the layout of the mass matrix, as in mj_factorM; inverse:
// nv, 1 / D.
void solve_tree(const mjModel* m, const mjtNum* factor, const mjtNum* inverse, DofRange range,
                mjtNum* x);

// The matrix H of MuJoCo's step, v' = v + h H^-1 f, in one block for each kinematic tree:
//   explicit dampers (RK4, or disabled)   M
//   Euler                                 M + h B,      B: the joints' dampers
//   implicit, implicitfast                M - h dF/dv,  F(v): actuators, dampers of joints and
//                                         tendons, fluid, bias forces; MuJoCo's own derivative,
//                                         which need not be symmetric
// An impulse that must obey the contact laws at the end of the step acts through this matrix. Uses
// the stack of mjData during its lifetime.
class StepMatrix {
 public:
  // Make it after mj_fwdActuation. Computes dF/dv once for all contacts of the pass.
  StepMatrix(const mjModel* m, mjData* d);

  // False if H is M in this tree.
  bool differs(DofRange tree) const;
  // row <- row H^-1 for the tree's entries of three rows of length nv, which follow one another.
  void solve(DofRange tree, mjtNum* rows);
  // to += (H - M) x for the tree's entries.
  void add_excess(DofRange tree, const mjtNum* x, mjtNum* to) const;

 private:
  void fill_excess(DofRange tree, mjtNum* block) const;

  const mjModel* m_;
  mjData* d_;
  StackFrame room_;
  bool implicit_;
  double damped_step_;  // s, the h of M + h B; not used by implicit integrators
  // M + h B = L^T D L and 1 / D of the trees that were needed, as in solve_tree; 1 / D is 0 in the
  // others.
  mjtNum *factor_ = nullptr, *inverse_ = nullptr;
};

}  // namespace rotorub::plugin
