#include "plugin/contact/smooth_force.h"

#include <algorithm>

#include "plugin/actuators.h"
#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {

void update_smooth_force(const mjModel* m, mjData* d) {
  compute_actuators(m, d);
  const mjtNum* applied = d->xfrc_applied;
  if (std::any_of(applied, applied + 6 * m->nbody, [](mjtNum f) { return f != 0.0; })) {
    mj_fwdAcceleration(m, d);
    return;
  }
  // The sum alone, without solving for the accelerations.
  for (int i = 0; i < m->nv; ++i) {
    const mjtNum actuator = actuator_count(m) > 0 ? d->qfrc_actuator[i] : 0.0;
    d->qfrc_smooth[i] = d->qfrc_passive[i] - d->qfrc_bias[i] + d->qfrc_applied[i] + actuator;
  }
}

}  // namespace rotorub::plugin
