// The matrix H of MuJoCo's step, v' = v + h H^-1 f, block by block of the kinematic trees:
//   dampers explicit (RK4, or disabled)   M
//   Euler                                 M + h B,      B the joints' dampers
//   implicit, implicitfast                M - h dF/dv,  F(v) actuators, dampers of joints and
//   tendons, fluid,
//                                         bias forces: MuJoCo's own derivative, which need not be
//                                         symmetric
// An impulse that is to meet the contact laws at the end of the step has to pass through it.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/contact/tree_factor.h"

namespace rotorub::plugin {

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
