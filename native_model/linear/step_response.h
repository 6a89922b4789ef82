// How the loop of magnetic bearings answers a step of force: the rotor at rest, and from t = 0 on a
// constant force on it at the station of a bearing, on one axis. In linear states x, of a sampled
// control from sample to sample,
//
//   x' = A x + B f between samples,   x+ = S x at each,   y = C x,
//
// y where the force acts, so that what stays of y is the loop's static compliance. Exact: powers of
// the map of a short step, e^{[A B; 0 0] h}, doubled over and over, give every instant; nothing is
// integrated. With an integrator that sees the bearing's own deflection nothing stays.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "native_model/linear/linear_loop.h"
#include "native_model/model/model.h"

namespace rotorub {

struct StepResponse {
  double steady = 0.0;               // m/N, what stays; 0 where that is round-off
  double largest = 0.0;              // m/N, signed, the most of |y|
  std::optional<double> largest_at;  // s; empty: what stays is the most
  // Of one whose steady deflection is at least kSteadyShare of the largest: s, from 10 % to 90 % of
  // it, and how far beyond it, as a share. Of others y comes back to the middle: no such figures.
  std::optional<double> rise_time, overshoot;
  // s, from when on |y - steady| keeps within 2 % of the steady deflection; where y comes back, of
  // the largest one.
  double settling_time = 0.0;
  // The curve: dense at first, then over every octave of t as many instants. An oscillation with
  // less damping than 0.5 % is met less than 8 times a period before it has settled.
  std::vector<double> t, y;  // s, m/N

  // N/m; empty: nothing stays.
  std::optional<double> static_stiffness() const {
    return steady == 0.0 ? std::nullopt : std::optional(1.0 / steady);
  }
  static constexpr double kSteadyShare = 0.02, kBand = 0.02;
};

// Two of each feedback that works, x before y. poles: of the loop, 1/s, all with a falling motion.
std::vector<StepResponse> step_responses(const Model& model, const LinearLoop& loop,
                                         const std::vector<std::complex<double>>& poles);

}  // namespace rotorub
