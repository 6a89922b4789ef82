// The step of MuJoCo with the plugin, linearised by differences.
//
// mjd_transitionFD puts back qpos, qvel, act and ctrl between its steps, but neither time nor
// userdata: loads that depend on time move on, and `rigid` of a generated model takes each nudged
// state for one that was set from outside (its first step is half a kick). Here every step starts
// from a copy of d, and the memory of `rigid` stays that of d. With y = (qpos, qvel, act) as
// MuJoCo's tangent coordinates, n = 2 nv + na:
//
//   dy_{k+1} = A dy_k + B du,     A: n x n, B: n x nu
//   ds_k     = C dy_k + D du,     C: ns x n, D: ns x nu,  s = sensordata (ns values); row-major
//
// of one step of the model's length, about the contact as it is: in flight that of the free rotor;
// in lasting contact with the gap held (a nudge that opens or closes it within eps is not seen:
// take eps below the step's margin); across an impact that of its law. Units are those of y over y
// and of y over ctrl, of s over them. ctrl that the scene's controller writes is no input: its
// columns of B are 0, and A has the loop closed. Means of two sides, error of order eps^2.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

namespace rotorub::plugin {

struct Transition {                           // of one step; row by row
  int states = 0, controls = 0, sensors = 0;  // n, nu, ns
  std::vector<double> A, B, C, D;
};

// The preloaded library answers mjd_transitionFD so, always by two sides. eps > 0, in units of each
// entry of y and u. d stays as it is.
Transition transition(const mjModel* m, const mjData* d, double eps = 1e-8);

// True in this thread while the steps of `transition` run.
bool differentiating();

}  // namespace rotorub::plugin
