// The inner loop of an ensemble: steps of a kernel of W lanes, and what is kept of them. Compiled
// once for each instruction set (lane_steps.cc): W = 8 for AVX-512, 4 for AVX2, 2 without either.
// Everything else that a kernel has is compiled for the least processor (lane_kernels.cc).
#pragma once

#include <cstdint>

#include "native_model/stepping/paper_step.h"
#include "native_model/stepping/verlet_step.h"

namespace rotorub {

template <int W>
using PaperLanes = PaperKernel<LaneModel<lanes::Lane<W>>>;
template <int W>
using VerletLanes = VerletKernel<LaneModel<lanes::Lane<W>>>;

template <int W>
struct LaneTotals {
  using T = lanes::Lane<W>;
  T first_touch = lanes::all<T>(-1.0);
  T contact_steps{}, impulse_total{}, peak_impulse{};
  std::int64_t impacts[W] = {};
};

// `advance`: steps [from, from + count) of one group. `velocities_now`: VerletKernel::velocity_now.
// What is done run by run is compiled elsewhere.
#define ROTORUB_LANE_STEPS(W)                                                                     \
  void advance(PaperLanes<W>& kernel, LaneTotals<W>& totals, double step, std::int64_t from,      \
               std::int64_t count);                                                               \
  void advance(VerletLanes<W>& kernel, LaneTotals<W>& totals, double step, std::int64_t from,     \
               std::int64_t count);                                                               \
  void velocities_now(VerletLanes<W>& kernel, std::int64_t k, lanes::Lane<W>* now);               \
  ROTORUB_RUN_BY_RUN(extern template, W)

#define ROTORUB_RUN_BY_RUN(template_, W)                                                          \
  template_ void StepKernel<LaneModel<lanes::Lane<W>>>::fail(int, Status);                        \
  template_ void StepKernel<LaneModel<lanes::Lane<W>>>::press_lane(int, const Centre&,            \
                                                                    const Eigen::Vector2d&); \
  template_ void StepKernel<LaneModel<lanes::Lane<W>>>::magnet_force(const T*, const T*, T*) const; \
  template_ void PaperLanes<W>::forget_impacts();                                                 \
  template_ void PaperLanes<W>::collide(int, std::int64_t);                                       \
  template_ void VerletLanes<W>::forget_impacts();                                                \
  template_ void VerletLanes<W>::collide(int, std::int64_t)

ROTORUB_LANE_STEPS(2);
ROTORUB_LANE_STEPS(4);
ROTORUB_LANE_STEPS(8);
#undef ROTORUB_LANE_STEPS

}  // namespace rotorub
