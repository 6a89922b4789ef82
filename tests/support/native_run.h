// Shipped scenes, and runs of the native model with the test's choice of integrator.
#pragma once

#include <string>
#include <vector>

#include "native_model/run/run_native.h"
#include "native_model/scene/reader.h"

namespace rotorub::test {

inline scene::Scene shipped(const std::string& name,
                            const std::vector<std::string>& overrides = {}) {
  return scene::read_scene(std::string(ROTORUB_MJCF_DIR) + "/" + name + ".toml", overrides);
}

// step: s; not used by `event`.
inline Trajectory run_with(const scene::Scene& scene, scene::Integrator integrator,
                           double step = 1e-5) {
  NativeOptions options;
  options.integrator = integrator;
  options.step = step;
  return run_native(scene, options);
}

inline Trajectory run_event(const scene::Scene& scene) {
  NativeOptions options;
  options.integrator = scene::Integrator::kEvent;
  return run_native(scene, options);
}

}  // namespace rotorub::test
