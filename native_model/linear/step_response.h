// Response of the loop of magnetic bearings to a step of force: the rotor is at rest, and for t > 0
// a constant force acts on it at the station of a bearing, along one axis. In linear states x (for
// a sampled control, from sample to sample)
//
//   x' = A x + B f between samples,   x+ = S x at each sample,   y = C x,
//
// with y taken where the force acts, so that its steady value is the loop's static compliance. The
// result is exact: repeated squaring of the map over a short step, e^{[A B; 0 0] h}, gives every
// instant without numerical integration. The steady value is 0 with an integrator that measures the
// deflection at the bearing itself.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "native_model/linear/linear_loop.h"
#include "native_model/model/model.h"

namespace rotorub {

struct StepResponse {
  double steady = 0.0;               // m/N, steady value; 0 if it is within round-off
  double largest = 0.0;              // m/N, signed, value of the largest |y|
  std::optional<double> largest_at;  // s; empty: the steady value is the largest
  // Only if the steady deflection is at least kSteadyShare of the largest: rise time from 10 % to
  // 90 % of it (s), and relative overshoot. Otherwise y returns to the centre and both are empty.
  std::optional<double> rise_time, overshoot;
  // s, time after which |y - steady| stays within 2 % of the steady deflection, or of the largest
  // one if y returns to the centre.
  double settling_time = 0.0;
  // The curve: dense at first, then equally many instants in every octave of t. An oscillation with
  // a damping ratio below 0.5 % is sampled fewer than 8 times per period before it has settled.
  std::vector<double> t, y;  // s, m/N

  // N/m; empty if the steady value is 0.
  std::optional<double> static_stiffness() const {
    return steady == 0.0 ? std::nullopt : std::optional(1.0 / steady);
  }
  static constexpr double kSteadyShare = 0.02, kBand = 0.02;
};

// Two responses for each working feedback, x before y. poles: of the loop, 1/s, all with negative
// real part.
std::vector<StepResponse> step_responses(const Model& model, const LinearLoop& loop,
                                         const std::vector<std::complex<double>>& poles);

}  // namespace rotorub
