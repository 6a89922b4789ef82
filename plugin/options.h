// What MuJoCo of today leaves out of a step: mjcb_control where actuation is disabled, and what
// sleeps.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"
#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {

// References of constraints that are changed before MuJoCo computes them,
//   aref = -B vel - K I (pos - margin),
// which it does after mjcb_passive. The constructor computes them; keep() makes MuJoCo find what
// they were changed to since, by the rows' `pos`. May be done again in the same pass.
class KeptReferences {
 public:
  KeptReferences(const mjModel* m, mjData* d);
  void keep();

 private:
  mjData* d_;
  StackFrame room_;
  mjtNum *aref_, *velocity_;  // as MuJoCo has them
};

// True where MuJoCo may put the rotor or the ring to sleep (<flag sleep="enable">): it does not
// wake for the plugin's loads.
bool may_fall_asleep(const Config& config, const mjModel* m);

// True where MuJoCo's solver takes <option>'s numbers for those of a contact that it solves for us.
bool is_overridden(const Config& config, const mjModel* m);

void refuse_sleep();     // mju_error
void refuse_override();  // mju_error
void refuse_silence();   // mju_error: neither mjcb_passive nor mjcb_control is called

// What contact model `rigid` says of MuJoCo's fourth-order integrator.

// mju_error for RK4: impulses are once a step, and its four stages are not.
void refuse_runge_kutta();

}  // namespace rotorub::plugin
