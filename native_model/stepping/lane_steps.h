// The inner loop of an ensemble: steps of a kernel of W lanes, and what is kept of them. Compiled
// once for each instruction set (lane_steps.cc): W = 8 for AVX-512, 4 for AVX2, 2 without either.
// Everything else that a kernel has is compiled for the least processor (lane_kernels.cc).
#pragma once

#include <cstdint>

#include "native_model/stepping/midpoint_step.h"
#include "native_model/stepping/verlet_step.h"

namespace rotorub {

template <int W>
using Lanes = LaneModel<lanes::Lane<W>>;

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
template <class Kernel, int W>
struct LaneWork {
  Kernel kernel;
  LaneTotals<W> totals;
};

// `advance`: steps [from, from + count) of the group. `velocities_now`: VerletKernel::velocity_now.
// What is done run by run is compiled elsewhere.
#define ROTORUB_LANE_STEPS(W, ...)                                                              \
  void advance(LaneWork<MidpointKernel<__VA_ARGS__>, W>& group, double step, std::int64_t from, \
               std::int64_t count);                                                             \
  void advance(LaneWork<VerletKernel<__VA_ARGS__>, W>& group, double step, std::int64_t from,   \
               std::int64_t count);                                                             \
  void velocities_now(VerletKernel<__VA_ARGS__>& kernel, std::int64_t k, lanes::Lane<W>* now);  \
  ROTORUB_RUN_BY_RUN(extern template, __VA_ARGS__)

#define ROTORUB_RUN_BY_RUN(template_, ...)                                                  \
  template_ void LoadKernel<__VA_ARGS__>::fail(int, Status);                                \
  template_ void LoadKernel<__VA_ARGS__>::magnet_force(const T*, const T*, T*) const;       \
  template_ void ContactKernel<__VA_ARGS__>::press_lane(int, const Centre&, const Centre&); \
  template_ void ContactKernel<__VA_ARGS__>::forget_impacts();                              \
  template_ void MidpointKernel<__VA_ARGS__>::collide(int, std::int64_t);                   \
  template_ void VerletImpacts<__VA_ARGS__>::find_lasting();                                \
  template_ void VerletImpacts<__VA_ARGS__>::show_lasting(int, std::int64_t, T*) const;     \
  template_ void VerletImpacts<__VA_ARGS__>::go_on_lasting(std::int64_t);                   \
  template_ void VerletImpacts<__VA_ARGS__>::collide(int, std::int64_t);                    \
  template_ void VerletJumps<__VA_ARGS__>::split(const Before&, double, double, T&, T&);

// Of W lanes, of any size and of each known one.
#define ROTORUB_SMALL_LANE_STEPS(L, W) ROTORUB_LANE_STEPS(W, Sized<Lanes<W>, L>)
#define ROTORUB_ALL_LANE_STEPS(W) \
  ROTORUB_LANE_STEPS(W, Lanes<W>) \
  ROTORUB_SMALL_LAYOUTS(ROTORUB_SMALL_LANE_STEPS, W)

ROTORUB_ALL_LANE_STEPS(2)
ROTORUB_ALL_LANE_STEPS(4)
ROTORUB_ALL_LANE_STEPS(8)

}  // namespace rotorub
