// Helpers that the tests of the shadow share.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "native_model/run/run_native.h"
#include "plugin/model/config.h"
#include "plugin/model/user_data.h"
#include "plugin/shadow.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {

inline scene::Scene shadowed(const std::string& name, std::vector<std::string> overrides = {}) {
  overrides.push_back("mujoco.shadow=true");
  return shipped(name, overrides);
}

// Coordinates of the time before the last mj_step, then velocities of half a step before it.
inline std::vector<double> shadow_of(const plugin::Config& config, const mjData* d) {
  const double* q = plugin::shadow_state(config, d);
  return {q, q + 2 * config.model.nq()};
}
inline std::vector<double> shadow_coordinates(const plugin::Config& config, const mjData* d) {
  const double* q = plugin::shadow_state(config, d);
  return {q, q + config.model.nq()};
}

inline const plugin::ShadowEntries& shadow_entries(const plugin::Config& config, const mjData* d) {
  return plugin::entries<plugin::ShadowEntries>(d, config.shadow->userdata);
}

inline Eigen::Vector2d point(const mjModel* m, const mjData* d, const char* name) {
  const mjtNum* p = d->sensordata + m->sensor_adr[mj_name2id(m, mjOBJ_SENSOR, name)];
  return {p[0], p[1]};
}

// A native run of `verlet` with a row at every step.
inline Trajectory every_step(const scene::Scene& scene, int steps) {
  NativeOptions options;
  options.integrator = scene::Integrator::kVerlet;
  options.output_times.emplace();
  for (int k = 0; k <= steps; ++k) options.output_times->push_back(k * scene.run.step);
  scene::Scene own = scene;
  own.run.end = options.output_times->back();
  return run_native(own, options);
}

using Shadow = HookedTest;

}  // namespace rotorub::test
