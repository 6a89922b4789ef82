// The forces of the actuators, once in a pass. The contact needs them in mjcb_control, and MuJoCo
// computes them behind it, again: whoever counts or filters in mjcb_act_dyn, _gain, _bias or in an
// engine plugin would be asked twice. So an answer that a callback gave to us is what MuJoCo gets,
// as long as time, state and controls are those of then (they are not where ctrl is set between
// mj_step1 and mj_step2). An engine plugin finds mjData.plugin_state as it left it; preloaded, its
// second computation is left out (register.cc), linked, one that is seen to depend on how often it
// is asked is warned of.
#pragma once

#include <mujoco/mujoco.h>

namespace rotorub::plugin {

// What MuJoCo asks of an actuator: mjcb_act_gain, mjcb_act_bias, mjcb_act_dyn.
enum class ActuatorQuestion : int { kGain, kBias, kRate };

// A pass begins: mjcb_control of d.
void begin_actuators(const mjData* d);

// For a control pass that no mj_fwdActuation of MuJoCo's follows (inverse.h).
class ActuatorsAside {
 public:
  ActuatorsAside(const mjModel* m, mjData* d);
  ~ActuatorsAside();
  ActuatorsAside(const ActuatorsAside&) = delete;
  ActuatorsAside& operator=(const ActuatorsAside&) = delete;

 private:
  const mjModel* m_;
  mjData* d_;
};

// In the place of mj_fwdActuation, for the passes of ours.
void compute_actuators(const mjModel* m, mjData* d);

// For MuJoCo's mj_fwdActuation, where one can stand before it: true where compute_actuators has
// done its work.
bool actuators_computed(const mjModel* m, mjData* d);
void expect_to_stand_before();

// After MuJoCo's: warns once of an engine plugin that gave another force than to us.
void compare_actuators(const mjModel* m, const mjData* d);

// The answer of a callback of others; given: true where there is one.
bool answer_given(ActuatorQuestion asked, const mjModel* m, const mjData* d, int id, mjtNum& value);
void keep_answer(ActuatorQuestion asked, const mjData* d, int id, mjtNum value);

// Of MuJoCo's generalised force without constraints, as it will be in the forward pass that is
// under way (mjcb_control is called before it is summed up): brings d->qfrc_actuator up to date
// with ctrl, and d->qfrc_smooth.
void update_smooth_force(const mjModel* m, mjData* d);

}  // namespace rotorub::plugin
