// The step of MuJoCo with the plugin, linearised by differences.
//
// mjd_transitionFD restores qpos, qvel, act and ctrl between its steps, but neither time nor
// userdata: loads that depend on time move on, and `rigid` of a generated model treats each nudged
// state as one that was set from outside (its first step is half a kick). Here every step starts
// from a copy of d, and `rigid` keeps the memory of d. With y = (qpos, qvel, act) in MuJoCo's
// tangent coordinates and n = 2 nv + na, one step of the model's length is
//
//   dy_{k+1} = A dy_k + B du,     A: n x n, B: n x nu
//   ds_k     = C dy_k + D du,     C: ns x n, D: ns x nu,  s = sensordata (ns values); row-major
//
// about the present contact state. In flight it is the step of the free rotor. In lasting contact
// the gap is held (a nudge that opens or closes it within eps is not noticed, so choose eps below
// the step's margin). Across an impact it contains the impact law. A has the units of y per y, B of
// y per ctrl, C of s per y, and D of s per ctrl. A ctrl that the scene's controller writes is not
// an input: its columns of B are 0, and A contains the closed loop. The differences are two-sided,
// with an error of order eps^2.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

namespace rotorub::plugin {

struct Transition {                           // for one step; row by row
  int states = 0, controls = 0, sensors = 0;  // n, nu, ns
  std::vector<double> A, B, C, D;
};

// In the preloaded library mjd_transitionFD calls this function, always with two-sided differences.
// eps > 0, in the unit of each entry of y and u. d does not change.
Transition transition(const mjModel* m, const mjData* d, double eps = 1e-8);

}  // namespace rotorub::plugin
