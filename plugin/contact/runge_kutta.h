// What contact model `rigid` says of MuJoCo's fourth-order integrator.
#pragma once

#include <mujoco/mujoco.h>

namespace rotorub::plugin {

// mju_error for RK4: impulses are once a step, and its four stages are not.
void refuse_runge_kutta();

}  // namespace rotorub::plugin
