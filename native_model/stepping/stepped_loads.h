// The loads of [[force]] and of the base's motion over fixed steps. A rotating force turns by a
// fixed angle each step; its sine and cosine are taken anew every kResync steps, so that round-off
// does not gather. A load that is switched or ramped counts with the mean of its envelope over the
// step, a pulse too.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "native_model/dynamics/loads.h"
#include "native_model/stepping/lane_model.h"

namespace rotorub {

// s: when a load is switched next after `from`, at most `end`.
double next_switch(const Model& model, double from, double end);

template <class T>
class SteppedLoads {
 public:
  static constexpr std::int64_t kResync = 256;

  // `models`: of the lanes; they must outlive this.
  SteppedLoads(const std::vector<const Model*>& models, double h);

  // The forces of step k: directions of the instant t (s), envelopes over [begin, end]. Asked again
  // for the same step it does nothing.
  ROTORUB_INLINE void advance(std::int64_t k, double t, double begin, double end) {
    if (k == now_) return;
    now_ = k;
    for (Load& load : loads_) {
      if (load.kind == scene::ForceKind::kRotating) turn(load, k, t);
      if (load.kind == scene::ForceKind::kChirp) sweep(load, t);
    }
    weigh(lanes::all<T>(begin), lanes::all<T>(end));
  }
  // After advance: the envelopes over another part of the step.
  ROTORUB_INLINE void weigh(const T& begin, const T& end) {
    if (based_) find_base(begin, end);
    for (Load& load : loads_) {
      const bool turns = load.turns();
      const T x = turns ? load.amplitude * load.cosine : load.vector_x;
      const T y = turns ? load.amplitude * load.sine : load.vector_y;
      if (load.kind == scene::ForceKind::kPulse) {
        mean_pulse(load, begin, end);
      } else {
        load.share = load.switched ? mean_envelope(load, begin, end) : lanes::all<T>(1.0);
      }
      load.x = load.share * x;
      load.y = load.share * y;
    }
  }
  // After advance, where there are loads locked to a free spin; phi of the step's instant, rad.
  bool synchronous() const { return synchronous_; }
  ROTORUB_INLINE void turn_with(const T& phi) {
    for (Load& load : loads_) {
      if (load.kind != scene::ForceKind::kSynchronous) continue;
      sine_cosine<T>(phi + load.phase, load.sine, load.cosine);
      load.x = load.share * load.amplitude * load.cosine;
      load.y = load.share * load.amplitude * load.sine;
    }
  }
  template <class M>
  ROTORUB_INLINE void add(const M& m, T* f) const {
    for (const Load& load : loads_) {
      equations::add_station_force(m.layout.modes, load.shape, load.x, load.y, f);
    }
    if (based_) equations::add_base_load(m, base_, f);
  }

  void forget() { now_ = -1; }
  // The numbers that outlive a step.
  template <class Action>
  void for_each_kept(Action action) {
    for (Load& load : loads_) {
      if (load.kind != scene::ForceKind::kRotating) continue;
      action(load.cosine);
      action(load.sine);
    }
  }

 private:
  struct Load {
    scene::ForceKind kind{};
    bool switched = false;
    T amplitude{}, frequency{}, phase{}, vector_x{}, vector_y{}, on{}, off{}, ramp{};
    T cosine{}, sine{}, turn_cosine{}, turn_sine{};  // now, and of one step
    T share{}, x{}, y{};                             // of the step; N, now
    std::vector<const AppliedForce*> of;             // each lane's
    bool turns() const {
      return kind != scene::ForceKind::kConstant && kind != scene::ForceKind::kPulse;
    }
    typename LaneModel<T>::Shape shape;
  };

  static ROTORUB_INLINE void point(Load& load, int lane, double angle) {
    lanes::set(load.cosine, lane, std::cos(angle));
    lanes::set(load.sine, lane, std::sin(angle));
  }

  ROTORUB_INLINE void turn(Load& load, std::int64_t k, double t) {
    if (k % kResync == 0) {
      for (int lane = 0; lane < lanes::kWidth<T>; ++lane) {
        point(load, lane, lanes::get(load.frequency, lane) * t + lanes::get(load.phase, lane));
      }
      return;
    }
    const T c = load.cosine, s = load.sine;
    load.cosine = c * load.turn_cosine - s * load.turn_sine;
    load.sine = s * load.turn_cosine + c * load.turn_sine;
  }

  // A chirp has no fixed angle a step.
  ROTORUB_SLOW void sweep(Load& load, double t) const {
    for (int lane = 0; lane < lanes::kWidth<T>; ++lane) {
      point(load, lane, load.of[static_cast<std::size_t>(lane)]->angle(t, 0.0));
    }
  }
  // Of sin(pi (t - on)/(off - on)), by its integral.
  ROTORUB_SLOW void mean_pulse(Load& load, const T& begins, const T& ends) const {
    for (int lane = 0; lane < lanes::kWidth<T>; ++lane) {
      const double from = lanes::get(begins, lane), to = lanes::get(ends, lane);
      const double on = lanes::get(load.on, lane), off = lanes::get(load.off, lane);
      const double begin = std::clamp(from, on, off), end = std::clamp(to, on, off);
      const double turn = std::numbers::pi / (off - on);
      // cos a - cos b = 2 sin((a + b)/2) sin((b - a)/2).
      const double integral = 2.0 / turn * std::sin(turn * (0.5 * (begin + end) - on)) *
                              std::sin(0.5 * turn * (end - begin));
      lanes::set(load.share, lane, integral / (to - from));
    }
  }

  ROTORUB_SLOW void find_base(const T& begin, const T& end) {
    for (int lane = 0; lane < lanes::kWidth<T>; ++lane) {
      const Eigen::Vector2d a = models_[static_cast<std::size_t>(lane)]->base->mean(
          lanes::get(begin, lane), lanes::get(end, lane));
      lanes::set(base_.x, lane, a.x());
      lanes::set(base_.y, lane, a.y());
    }
  }

  // Integral of the envelope from `on` to t, s: t - on - ramp / 2 once the ramp is over.
  ROTORUB_INLINE T risen(const Load& load, const T& t) const {
    const T zero{}, half = lanes::all<T>(0.5), one = lanes::all<T>(1.0);
    const T since = lanes::larger(zero, t - load.on);
    const T length = lanes::select(load.ramp > zero, load.ramp, one);
    return lanes::select(since < load.ramp, half * since * since / length,
                         since - half * load.ramp);
  }
  ROTORUB_INLINE T mean_envelope(const Load& load, const T& begin, const T& end) const {
    const auto until = [&](const T& x) { return lanes::select(x < load.off, x, load.off); };
    const T mean = (risen(load, until(end)) - risen(load, until(begin))) / (end - begin);
    // Exactly 1 where nothing changes within the step.
    const auto whole = (begin >= load.on + load.ramp) & (end <= load.off);
    return lanes::select(whole, lanes::all<T>(1.0), mean);
  }

  std::int64_t now_ = -1;
  bool synchronous_ = false, based_ = false;
  std::vector<Load> loads_;
  equations::Pair<T> base_{};         // m/s^2, the base's acceleration over the step
  std::vector<const Model*> models_;  // of the lanes
};

}  // namespace rotorub
