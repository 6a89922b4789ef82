// [run] of a scene (scene.h).
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace rotorub::scene {

// event: adaptive steps between located events; verlet: fixed steps of second order; euler: the
// fixed steps of Chavez and Ulbrich, (10)-(13), of first order.
enum class Integrator { kEvent, kVerlet, kEuler };

struct Run {                                   // duration, resolution and output of a run
  double end = 1.0;                            // s, > 0
  double step = 1e-5;                          // s, > 0: fixed step of `verlet`, `euler` and MuJoCo
  Integrator integrator = Integrator::kEvent;  // of the native engine
  std::optional<double> output_step;           // s, > 0; default end / 1000
  std::vector<double> output_times;            // s, in [0, end], ascending after reading
  double series_step() const { return output_step.value_or(end / 1000.0); }
};

// Number of steps of length `step` (s) that reach `end` (s); a remainder of less than 1e-9 steps is
// round-off.
inline std::int64_t step_count(double end, double step) {
  return static_cast<std::int64_t>(std::ceil(end / step - 1e-9));
}

}  // namespace rotorub::scene
