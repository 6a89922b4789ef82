// The machine in MuJoCo as a linear system about its present contact state, in continuous time:
//
//   dy/dt = A y + B u,   s = C y + D u,     y = (qpos, qvel, act), u = ctrl,
//
// where y and u are differences from their present values. Its solution over a step, exp(A h),
// equals the result of `transition` (differences.h) up to the plugin's error of a step. In lasting
// contact the gap and its rate are not states: y is projected onto what the contact leaves free,
// and A maps into that space. Motions that would open or close the gap vanish (their eigenvalues
// are 0). A controller can be designed on it as on any plant; it is valid until contact is made or
// lost. The rates are those of MuJoCo's qvel; for `rigid` of a generated model they are half a step
// older than qpos. There the first step from a state that was set is half a kick, so for such a
// state the next step is linearised instead.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>

namespace rotorub::plugin {

// The linearisation of a MuJoCo model at its present state.
struct LinearSystem {
  Eigen::MatrixXd A, B, C, D;  // n x n (1/s), n x nu, ns x n, ns x nu; n = 2 nv + na
  Eigen::MatrixXd held;        // n x n: the projection onto what the contact holds; 0 in flight
};

// eps: as in `transition`. Throws std::invalid_argument for eps <= 0, and std::runtime_error if a
// mode is so fast for the step that it has no continuous counterpart (it turns by half a turn or
// more in a step), or if the step's eigenvalues or its logarithm are not found.
LinearSystem linearise(const mjModel* m, const mjData* d, double eps = 1e-8);

}  // namespace rotorub::plugin
