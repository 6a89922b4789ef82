// Compiled once for each instruction set, with ROTORUB_LANES lanes (native_model/CMakeLists.txt).
// Nothing but code of this width may come out of it: a function that another file shares, compiled
// for a larger processor than the one it runs on, would be fatal (tests/package/lane_symbols.cmake).
#include "native_model/stepping/lane_steps.h"

namespace rotorub {
namespace {

constexpr int W = ROTORUB_LANES;
static_assert(alignof(Eigen::Vector2d) == 16, "laid out as elsewhere");

template <class Kernel>
ROTORUB_INLINE void advance_all(Kernel& kernel, LaneTotals<W>& totals, double step,
                                std::int64_t from, std::int64_t count) {
  using T = lanes::Lane<W>;
  const T zero{}, one = lanes::all<T>(1.0);
  for (std::int64_t k = from; k < from + count; ++k) {
    kernel.step(k);
    const T impulse = kernel.normal_impulse;
    const lanes::LaneMask<W> touched = impulse > zero;
    if (!lanes::any(touched)) continue;
    const T now = lanes::all<T>(static_cast<double>(k) * step);
    totals.first_touch =
        lanes::select(touched & (totals.first_touch < zero), now, totals.first_touch);
    totals.contact_steps += lanes::select(touched, one, zero);
    totals.impulse_total += impulse;
    totals.peak_impulse = lanes::larger(totals.peak_impulse, impulse);
    if (!kernel.any_impact()) continue;
    for (int lane = 0; lane < W; ++lane) {
      for (int i = 0; i < kernel.impacts[lane].count; ++i) {
        if (kernel.impacts[lane].impact[static_cast<unsigned>(i)].gap_rate_before < kCountedGapRate) {
          ++totals.impacts[lane];
        }
      }
    }
  }
}

}  // namespace

void advance(PaperLanes<W>& kernel, LaneTotals<W>& totals, double step, std::int64_t from,
             std::int64_t count) {
  advance_all(kernel, totals, step, from, count);
}
void advance(VerletLanes<W>& kernel, LaneTotals<W>& totals, double step, std::int64_t from,
             std::int64_t count) {
  advance_all(kernel, totals, step, from, count);
}
void velocities_now(VerletLanes<W>& kernel, std::int64_t k, lanes::Lane<W>* now) {
  kernel.velocity_now(k, now);
}

}  // namespace rotorub
