// The inner loop of an ensemble: steps of W lanes, and what is kept of them. Compiled once for each
// instruction set (lane_steps.cc): W = 8 for AVX-512, 4 for AVX2, 2 without either. What is done
// run by run is declared in the headers of the step and compiled for the least processor.
#pragma once

#include <cstdint>

#include "native_model/stepping/verlet_step.h"

namespace rotorub {

template <int W>
struct LaneTotals {
  using T = lanes::Lane<W>;
  T first_touch = lanes::all<T>(-1.0);
  T contact_steps{}, impulse_total{}, peak_impulse{};
  T friction_work{};  // J
  T farthest{};       // m^2, |d|^2 at the end of a step in contact: no other leaves the ring
  double peak_impact[W] = {};  // N s, of one impact
  std::int64_t impacts[W] = {};
};

// One group of lanes.
template <int W>
struct LaneWork {
  VerletStep<Lanes<W>> step;
  LaneTotals<W> totals;
};

// Steps [from, from + count) of the group.
template <int W>
void advance(LaneWork<W>& group, std::int64_t from, std::int64_t count);
// VerletStep::velocity_now, nq values.
template <int W>
void velocities_now(VerletStep<Lanes<W>>& step, std::int64_t k, lanes::Lane<W>* now);

}  // namespace rotorub
