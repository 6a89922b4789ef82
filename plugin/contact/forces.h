// The contact forces of a forward pass, whichever model made them.
#pragma once

#include <mujoco/mujoco.h>

#include "native_model/trajectory/trajectory.h"
#include "plugin/config.h"

namespace rotorub::plugin {

struct ContactForces {
  double normal = 0.0;    // N, >= 0
  double friction = 0.0;  // N, on the rotor along e_t
  Mode mode = Mode::kFree;
  // `rigid`: the forces are an impact's impulses over the step. Rates before and after it, m/s.
  bool impact = false;
  double impact_time = 0.0;  // s; 0: not known (segments, own models)
  double gap_rate_before = 0.0, gap_rate_after = 0.0, slip_before = 0.0, slip_after = 0.0;
  Status status = Status::kOk;  // `rigid`: of the contact laws
};

// After mj_forward or mj_step: of the forward pass done last.
// Of several contacts the first.
ContactForces contact_forces(const Config& config, const mjModel* m, const mjData* d);
// Of one contact of a user's own model.
ContactForces contact_forces(const ContactPair& pair, const mjModel* m, const mjData* d);

}  // namespace rotorub::plugin
