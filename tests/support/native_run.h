// Shipped scenes, and runs of the native model with the test's choice of integrator.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "native_model/run/run_native.h"
#include "native_model/scene/reader.h"

namespace rotorub::test {

inline scene::Scene shipped(const std::string& name,
                            const std::vector<std::string>& overrides = {}) {
  return scene::read_scene(std::string(ROTORUB_MJCF_DIR) + "/" + name + ".toml", overrides);
}

// A run that may end early. step: s; not used by `event`.
inline Trajectory attempt_with(const scene::Scene& scene, scene::Integrator integrator,
                               double step = 1e-5) {
  NativeOptions options;
  options.integrator = integrator;
  options.step = step;
  return run_native(scene, options);
}

inline Trajectory attempt_event(const scene::Scene& scene) {
  NativeOptions options;
  options.integrator = scene::Integrator::kEvent;
  return run_native(scene, options);
}

// Passes on a run that reached its end; the test fails with the reason of another.
inline Trajectory complete(Trajectory t) {
  if (t.status != Status::kOk) throw std::runtime_error("incomplete run: " + t.message);
  return t;
}

inline Trajectory run_with(const scene::Scene& scene, scene::Integrator integrator,
                           double step = 1e-5) {
  return complete(attempt_with(scene, integrator, step));
}

inline Trajectory run_event(const scene::Scene& scene) { return complete(attempt_event(scene)); }

// The row of this time.
inline std::size_t row_of(const Trajectory& t, double time) {
  constexpr double kRows = 1e-12;  // s, accuracy of the times in both outputs
  const std::vector<double>& times = t.column("t");
  const auto found = std::lower_bound(times.begin(), times.end(), time - kRows);
  return static_cast<std::size_t>(found - times.begin());
}

// The largest absolute value of a column.
inline double largest_size(const Trajectory& t, const std::string& column) {
  double most = 0.0;
  for (const double value : t.column(column)) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace rotorub::test
