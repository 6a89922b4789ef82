// The loads of [[force]] over fixed steps. A rotating force turns by a fixed angle each step; its
// sine and cosine are taken anew every kResync steps, so that round-off does not gather. A load
// that is switched or ramped counts with the mean of its envelope over the step.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "native_model/dynamics/equations.h"
#include "native_model/stepping/lane_model.h"

namespace rotorub {

template <class T>
class SteppedLoads {
 public:
  static constexpr std::int64_t kResync = 256;

  SteppedLoads(const std::vector<const Model*>& models, double h);

  // The forces of step k: directions of the instant t (s), envelopes over [begin, end]. Asked again
  // for the same step it does nothing.
  ROTORUB_INLINE void advance(std::int64_t k, double t, double begin, double end) {
    if (k == now_) return;
    now_ = k;
    for (Load& load : loads_) {
      if (load.rotating) turn(load, k, t);
      const T x = load.rotating ? load.amplitude * load.cosine : load.vector_x;
      const T y = load.rotating ? load.amplitude * load.sine : load.vector_y;
      const T share = load.switched ? mean_envelope(load, begin, end) : lanes::all<T>(1.0);
      load.x = share * x;
      load.y = share * y;
    }
  }
  ROTORUB_INLINE void add(int modes, T* f) const {
    for (const Load& load : loads_) {
      equations::add_station_force(modes, load.shape, load.x, load.y, f);
    }
  }

  void forget() { now_ = -1; }
  // The numbers that outlive a step.
  template <class Action>
  void for_each_kept(Action action) {
    for (Load& load : loads_) {
      if (!load.rotating) continue;
      action(load.cosine);
      action(load.sine);
    }
  }

 private:
  struct Load {
    bool rotating = false, switched = false;
    T amplitude{}, frequency{}, phase{}, vector_x{}, vector_y{}, on{}, off{}, ramp{};
    T cosine{}, sine{}, turn_cosine{}, turn_sine{};  // now, and of one step
    T x{}, y{};                                      // N, now
    typename LaneModel<T>::Shape shape;
  };

  ROTORUB_INLINE void turn(Load& load, std::int64_t k, double t) {
    if (k % kResync == 0) {
      for (int lane = 0; lane < lanes::kWidth<T>; ++lane) {
        const double angle = lanes::get(load.frequency, lane) * t + lanes::get(load.phase, lane);
        lanes::set(load.cosine, lane, std::cos(angle));
        lanes::set(load.sine, lane, std::sin(angle));
      }
      return;
    }
    const T c = load.cosine, s = load.sine;
    load.cosine = c * load.turn_cosine - s * load.turn_sine;
    load.sine = s * load.turn_cosine + c * load.turn_sine;
  }

  // Integral of the envelope from `on` to t, s: t - on - ramp / 2 once the ramp is over.
  ROTORUB_INLINE T risen(const Load& load, const T& t) const {
    const T zero{}, half = lanes::all<T>(0.5), one = lanes::all<T>(1.0);
    const T since = lanes::larger(zero, t - load.on);
    const T length = lanes::select(load.ramp > zero, load.ramp, one);
    return lanes::select(since < load.ramp, half * since * since / length,
                         since - half * load.ramp);
  }
  ROTORUB_INLINE T mean_envelope(const Load& load, double from, double to) const {
    const T begin = lanes::all<T>(from), end = lanes::all<T>(to);
    const auto until = [&](const T& x) { return lanes::select(x < load.off, x, load.off); };
    const T mean = (risen(load, until(end)) - risen(load, until(begin))) / lanes::all<T>(to - from);
    // Exactly 1 where nothing changes within the step.
    const auto whole = (begin >= load.on + load.ramp) & (end <= load.off);
    return lanes::select(whole, lanes::all<T>(1.0), mean);
  }

  std::int64_t now_ = -1;
  std::vector<Load> loads_;
};

}  // namespace rotorub
