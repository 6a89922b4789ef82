// The forces of the actuators, computed once in a pass.
//
// The contact needs these forces in mjcb_control, and MuJoCo computes them again afterwards. A
// program that counts or filters in mjcb_act_dyn, _gain, _bias or in an engine plugin would then be
// called twice. Therefore MuJoCo receives the answer that a callback gave to the plugin, as long as
// time, state and controls are unchanged. (They change if ctrl is set between mj_step1 and
// mj_step2.)
//
// An engine plugin finds mjData.plugin_state as it left it. If this library is preloaded, the
// second computation is left out (register.cc). If it is linked, the user is warned of an engine
// plugin whose force depends on how often it is computed.
#pragma once

#include <mujoco/mujoco.h>

namespace rotorub::plugin {

// The value that MuJoCo requests for an actuator, by mjcb_act_gain, mjcb_act_bias or mjcb_act_dyn.
enum class ActuatorQuestion : int { kGain, kBias, kRate };

// Begins a pass; called in mjcb_control of d.
void begin_actuators(const mjData* d);

// For a control pass that MuJoCo's mj_fwdActuation does not follow (inverse.h).
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

// Replaces mj_fwdActuation in the plugin's own computations.
void compute_actuators(const mjModel* m, mjData* d);

// For the preloaded library, which replaces MuJoCo's mj_fwdActuation: true if compute_actuators has
// already done its work.
bool actuators_computed(const mjModel* m, mjData* d);
// The preloaded library calls set_preloaded() once. It stands before MuJoCo: it replaces
// mj_fwdActuation, and MuJoCo calls it after mj_sensorAcc.
void set_preloaded();
bool is_preloaded();
// Call it after mj_step1: the program may edit mjModel before mj_step2, so that the forces must be
// computed again, except those of engine plugins, which are computed once.
void allow_edits(const mjModel* m, const mjData* d);

// Call it after MuJoCo's mj_fwdActuation. It warns once if an engine plugin computed another force
// than before.
void compare_actuators(const mjModel* m, const mjData* d);

// The answers of other programs' callbacks. answer_given: true, with the answer in `value`, if one
// is known.
bool answer_given(ActuatorQuestion asked, const mjModel* m, const mjData* d, int id, mjtNum& value);
void keep_answer(ActuatorQuestion asked, const mjData* d, int id, mjtNum value);

// Brings d->qfrc_actuator up to date with ctrl, and d->qfrc_smooth, MuJoCo's generalised force
// without constraints, to what it will be in the present forward pass. (MuJoCo calls mjcb_control
// before it sums that force up.)
void update_smooth_force(const mjModel* m, mjData* d);

}  // namespace rotorub::plugin
