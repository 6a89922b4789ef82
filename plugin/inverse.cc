#include "plugin/inverse.h"

#include <algorithm>

#include "plugin/callbacks.h"
#include "plugin/config_cache.h"
#include "plugin/model/actuators.h"
#include "plugin/model/mujoco_versions.h"
#include "plugin/model/user_data.h"
#include "plugin/passes.h"

namespace rotorub::plugin {

void inverse_with_contact(const mjModel* m, mjData* d, int skipstage, int skipsensor,
                          void (*inverse)(const mjModel*, mjData*, int, int)) {
  // If the velocity stage is skipped (mj_compareFwdInv), the results of mjcb_control are still
  // there.
  const Config* config = callbacks_active() ? find_config(m, d) : nullptr;
  if (skipstage >= mjSTAGE_VEL || !config) {
    inverse(m, d, skipstage, skipsensor);
    return;
  }
  mjtNum& fresh = model_entries(*config, d).passive_fresh;
  StackFrame room(d);
  mjtNum* memory = room.numbers(count(m->nuserdata));
  mjtNum* ctrl = room.numbers(std::max(count(m->nu), 1));
  const int nv = std::max(count(m->nv), 1);
  mjtNum *given = room.numbers(nv), *warm = room.numbers(nv);
  inverse(m, d, skipstage, skipsensor);
  std::copy_n(d->userdata, m->nuserdata, memory);
  std::copy_n(d->ctrl, m->nu, ctrl);
  // The contacts may run the solver, whose result is an acceleration too.
  std::copy_n(d->qacc, m->nv, given);
  std::copy_n(d->qacc_warmstart, m->nv, warm);
  {
    const ActuatorsAside aside(m, d);
    control_pass(m, d);
  }
  std::copy_n(given, m->nv, d->qacc);
  std::copy_n(warm, m->nv, d->qacc_warmstart);
  // Again from the velocities on, with the forces and references that control_pass has set.
  inverse(m, d, mjSTAGE_VEL, skipsensor);
  std::copy_n(memory, m->nuserdata, d->userdata);
  std::copy_n(ctrl, m->nu, d->ctrl);
  fresh = 0.0;  // no forward pass may continue from here
}

}  // namespace rotorub::plugin
