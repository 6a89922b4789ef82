// The machine in MuJoCo as a linear system about its present contact state, in continuous time:
//
//   dy/dt = A y + B u,   s = C y + D u,     y = (qpos, qvel, act), u = ctrl, both less those of now
//
// the one whose solution over a step is that of `transition` (differences.h): exp(A h), to the
// plugin's error of a step. In lasting contact the gap and its rate are no states: y is projected
// onto what the contact leaves free, A maps it into that, and what would open or close the gap has
// no future (its eigenvalues are 0). A controller is designed on it as on any plant; it holds until
// contact is made or lost. Rates are those of MuJoCo's qvel: with `rigid` of a generated model half
// a step before qpos. Its first step from a state that was set is half a kick: of such a state the
// step after that one is told.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>

namespace rotorub::plugin {

struct LinearSystem {          // in continuous time
  Eigen::MatrixXd A, B, C, D;  // n x n (1/s), n x nu, ns x n, ns x nu; n = 2 nv + na
  Eigen::MatrixXd held;        // n x n: the projection onto what the contact holds; 0 in flight
};

// eps as in `transition`. Throws std::invalid_argument for eps <= 0, std::runtime_error where a
// mode is so fast for the step that it has no continuous counterpart (it turns by more than half a
// turn a step), or where the step's eigenvalues or its logarithm are not found.
LinearSystem linearise(const mjModel* m, const mjData* d, double eps = 1e-8);

}  // namespace rotorub::plugin
