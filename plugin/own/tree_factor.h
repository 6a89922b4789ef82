// M + h D = L^T D L of single kinematic trees: M is of blocks, one a tree, and the degrees of freedom
// of a tree follow each other. What is not in the trees of rotor and ring costs nothing.
#pragma once

#include <mujoco/mujoco.h>

namespace rotorub::plugin {

// Degrees of freedom first <= i < last.
struct DofRange {
  int first = 0, last = 0;
};

// Those of the tree that the body is in; empty for what is fixed to the world.
DofRange tree_of(const mjModel* m, int body);

// The sums of MuJoCo's sparse factorisation (mj_factorM), of the rows of `range`. factor: as
// the mass (mass_size), inverse: nv, 1 / D. damped_step: s, h; 0: M alone.
void factor_tree(const mjModel* m, const mjtNum* mass, double damped_step, DofRange range,
                 mjtNum* factor, mjtNum* inverse);

// x <- (M + h D)^-1 x, in place, of the entries of `range`.
void solve_tree(const mjModel* m, const mjtNum* factor, const mjtNum* inverse, DofRange range,
                mjtNum* x);

}  // namespace rotorub::plugin
