// What the tests of the shadow share.
#pragma once

#include <vector>

#include "plugin/config.h"
#include "plugin/shadow.h"
#include "plugin/user_data.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {

inline scene::Scene shadowed(const std::string& name, std::vector<std::string> overrides = {}) {
  overrides.push_back("mujoco.shadow=true");
  return shipped(name, overrides);
}

// Coordinates, then velocities, of the time before the last mj_step.
inline std::vector<double> shadow_of(const plugin::Config& config, const mjData* d) {
  const double* q = plugin::shadow_state(config, d);
  return {q, q + 2 * config.model.nq()};
}

inline double entry(const plugin::Config& config, const mjData* d, plugin::ShadowEntry which) {
  return d->userdata[config.shadow->data + which];
}

}  // namespace rotorub::test
