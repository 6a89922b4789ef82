// An impact within a step of `verlet` (verlet_step.h), of one run.
#pragma once

#include <Eigen/Core>
#include <span>

#include "native_model/system/model.h"

namespace rotorub {

// At the share theta of the step of h (s) from t on.
struct ImpactInstant {
  double t = 0.0, h = 0.0, theta = 0.0;
  const double* q = nullptr;                           // coordinates at which M and loads are taken
  const double *v = nullptr, *acceleration = nullptr;  // of the step's middle before the impact
  std::span<const Eigen::Vector2d> commands;           // that hold over the step
};

// jump: in, the load of the impulses; out, what the velocities jump by. missed: what the loads that
// depend on velocities miss of it, -(theta - 1/2) h M^-1 (F(v + jump) - F(v)). nq values each. A
// continuous controller sees the jump too. Gives the work that the mean of the step's velocities
// misses, J.
double jump_velocities(const Model& m, const ImpactInstant& at, double* jump, double* missed);

}  // namespace rotorub
