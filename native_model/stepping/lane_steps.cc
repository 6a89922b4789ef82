// Compiled once for each instruction set, with ROTORUB_LANES lanes (native_model/CMakeLists.txt).
// Nothing but code of this width may come out of it: a function that another file shares, compiled
// for a larger processor than the one it runs on, would be fatal
// (tests/package/lane_symbols.cmake).
#include "native_model/stepping/lane_steps.h"

namespace rotorub {
namespace {

constexpr int W = ROTORUB_LANES;
static_assert(alignof(Eigen::Vector2d) == 16, "laid out as elsewhere");

// Of the lanes with impacts in this step; their friction works by its own slips.
template <class Kernel>
ROTORUB_INLINE void count_impacts(const Kernel& kernel, LaneTotals<W>& totals,
                                  typename Kernel::T& work) {
  for (int lane = 0; lane < W; ++lane) {
    const auto l = static_cast<std::size_t>(lane);
    const ImpactList& list = kernel.impacts[l];
    double of_impacts = 0.0;
    for (int i = 0; i < list.count; ++i) {
      const Impact& hit = list.impact[static_cast<unsigned>(i)];
      if (hit.gap_rate_before < kCountedGapRate) ++totals.impacts[l];
      if (hit.normal_impulse > totals.peak_impact[l]) totals.peak_impact[l] = hit.normal_impulse;
      of_impacts += 0.5 * hit.friction_impulse * (hit.slip_before + hit.slip_after);
    }
    if (list.count > 0) lanes::set(work, lane, of_impacts);
  }
}

// Impacts that take time are in contact that long, with the force of their mean.
template <class Kernel>
ROTORUB_INLINE void spread(const Kernel& kernel, double step, typename Kernel::T& steps,
                           typename Kernel::T& impulse) {
  for (int lane = 0; lane < W; ++lane) {
    if (!(kernel.impact_time[lane] > 0.0)) continue;
    const double taken = kernel.impact_time[lane] / step;
    lanes::set(steps, lane, taken);
    lanes::set(impulse, lane, lanes::get(impulse, lane) / taken);
  }
}

template <class Kernel>
ROTORUB_INLINE void advance_one(LaneWork<Kernel, W>& work, double step, std::int64_t k) {
  using T = lanes::Lane<W>;
  const T zero{}, one = lanes::all<T>(1.0);
  Kernel& kernel = work.kernel;
  LaneTotals<W>& totals = work.totals;
  kernel.step(k);
  const T impulse = kernel.normal_impulse;
  const lanes::LaneMask<W> touched = impulse > zero;
  if (!lanes::any(touched)) return;
  const T now = lanes::all<T>(static_cast<double>(k) * step);
  totals.first_touch =
      lanes::select(touched & (totals.first_touch < zero), now, totals.first_touch);
  T steps = lanes::select(touched, one, zero);
  totals.impulse_total += impulse;
  T peak = impulse;
  if constexpr (requires { kernel.impact_time; }) {
    if (kernel.any_impact()) spread(kernel, step, steps, peak);
  }
  totals.contact_steps += steps;
  totals.peak_impulse = lanes::larger(totals.peak_impulse, peak);
  totals.farthest = lanes::larger(totals.farthest, kernel.square_of_relative());
  T friction_work = kernel.friction_impulse * kernel.slip_of_last();
  if (kernel.any_impact()) count_impacts(kernel, totals, friction_work);
  totals.friction_work += friction_work;
}

template <class Kernel>
ROTORUB_INLINE void advance_all(LaneWork<Kernel, W>& group, double step, std::int64_t from,
                                std::int64_t count) {
  for (std::int64_t k = from; k < from + count; ++k) advance_one(group, step, k);
}

}  // namespace

#define ROTORUB_DEFINE(M)                                                             \
  void advance(LaneWork<MidpointKernel<M>, W>& group, double step, std::int64_t from, \
               std::int64_t count) {                                                  \
    advance_all(group, step, from, count);                                            \
  }                                                                                   \
  void advance(LaneWork<VerletKernel<M>, W>& group, double step, std::int64_t from,   \
               std::int64_t count) {                                                  \
    advance_all(group, step, from, count);                                            \
  }                                                                                   \
  void velocities_now(VerletKernel<M>& kernel, std::int64_t k, lanes::Lane<W>* now) { \
    kernel.velocity_now(k, now);                                                      \
  }
template <class L>
using SizedLanes = Sized<Lanes<W>, L>;
#define ROTORUB_DEFINE_SMALL(L, unused) ROTORUB_DEFINE(SizedLanes<L>)

ROTORUB_DEFINE(Lanes<W>)
ROTORUB_SMALL_LAYOUTS(ROTORUB_DEFINE_SMALL, )

}  // namespace rotorub
