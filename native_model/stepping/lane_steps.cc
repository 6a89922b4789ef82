// Compiled once for each instruction set, with ROTORUB_LANES lanes (native_model/CMakeLists.txt).
// Nothing but code of this width may come out of it: a function that another file shares, compiled
// for a larger processor than the one it runs on, would be fatal
// (tests/package/lane_symbols.cmake).
#include "native_model/stepping/lane_steps.h"

namespace rotorub {
namespace {

constexpr int W = ROTORUB_LANES;
using Step = VerletStep<Lanes<W>>;
using T = Step::T;
static_assert(alignof(Eigen::Vector2d) == 16, "laid out as elsewhere");

// Of the lanes with impacts in this step; their friction works by its own slips.
ROTORUB_INLINE void count_impacts(const Step& step, LaneTotals<W>& totals, T& work) {
  for (int lane = 0; lane < W; ++lane) {
    const auto l = static_cast<std::size_t>(lane);
    const ImpactList& list = step.contact.impacts[l];
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
ROTORUB_INLINE void spread(const Step& step, T& steps, T& impulse) {
  for (int lane = 0; lane < W; ++lane) {
    if (!(step.impact_time[lane] > 0.0)) continue;
    const double taken = step.impact_time[lane] / step.x.h;
    lanes::set(steps, lane, taken);
    lanes::set(impulse, lane, lanes::get(impulse, lane) / taken);
  }
}

ROTORUB_INLINE void advance_one(LaneWork<W>& work, std::int64_t k) {
  const T zero{}, one = lanes::all<T>(1.0);
  Step& step = work.step;
  LaneTotals<W>& totals = work.totals;
  step.step(k);
  const T impulse = step.contact.normal_impulse();
  const lanes::LaneMask<W> touched = impulse > zero;
  if (!lanes::any(touched)) return;
  const T now = lanes::all<T>(static_cast<double>(k) * step.x.h);
  totals.first_touch =
      lanes::select(touched & (totals.first_touch < zero), now, totals.first_touch);
  T steps = lanes::select(touched, one, zero);
  totals.impulse_total += impulse;
  T peak = impulse;
  if (step.contact.impacted) spread(step, steps, peak);
  totals.contact_steps += steps;
  totals.peak_impulse = lanes::larger(totals.peak_impulse, peak);
  totals.farthest = lanes::larger(totals.farthest, step.contact.square_of_relative(step.x));
  T friction_work = step.contact.friction_impulse() * step.slip_of_last();
  if (step.contact.impacted) count_impacts(step, totals, friction_work);
  totals.friction_work += friction_work;
}

}  // namespace

template <>
void advance<W>(LaneWork<W>& group, std::int64_t from, std::int64_t count) {
  for (std::int64_t k = from; k < from + count; ++k) advance_one(group, k);
}

template <>
void velocities_now<W>(Step& step, std::int64_t k, T* now) {
  step.velocity_now(k, now);
}

}  // namespace rotorub
