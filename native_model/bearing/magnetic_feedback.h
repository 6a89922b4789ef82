// A magnetic bearing that holds the rotor by a feedback of its own, on one axis: the linear magnet and
// a proportional-derivative law without memory (Schweitzer, Maslen: Magnetic Bearings, 2009, chapters 2
// and 4), r the deflection at its station, i the control current beyond the bias,
//
//   i = clamp(-(P r + D r'), -limit, limit),     F = k_s r + k_i i     for t < fails_at,
//
// from then on i = 0 and F = 0. Its linear law is a spring k_i P - k_s and a damper k_i D. A model has that
// spring for all time (the modes' stiffness, the stored energy), and here what F is beyond it.
#pragma once

#include "native_model/numerics/lanes.h"

namespace rotorub {

template <class T>
struct MagneticFeedback {
  T negative_stiffness{};        // N/m, k_s >= 0
  T force_per_current{};         // N/A, k_i > 0
  T proportional{}, derivative{};  // A/m, A s/m, P, D >= 0
  T current_limit{};             // A, > 0, infinity: none
  T fails_at{};                  // s, >= 0
  T held{};                      // N/m: a spring that others have for it, taken back here

  T stiffness() const { return force_per_current * proportional - negative_stiffness; }  // N/m
  T damping() const { return force_per_current * derivative; }                           // N s/m

  // A, while it works.
  ROTORUB_INLINE T current(const T& r, const T& rate) const {
    const T asked = -(proportional * r + derivative * rate);
    const T capped = lanes::select(asked > current_limit, current_limit, asked);
    return lanes::select(capped < -current_limit, -current_limit, capped);
  }
  // N, what it does beyond the spring `held`, working for `share` of the time, in [0, 1].
  ROTORUB_INLINE T force(const T& share, const T& r, const T& rate) const {
    return held * r + share * (negative_stiffness * r + force_per_current * current(r, rate));
  }
  // The share of the time from begin to end (s) for which it works; of an instant 0 or 1.
  static double working(double fails_at, double begin, double end) {
    if (begin >= fails_at) return 0.0;
    return end <= fails_at ? 1.0 : (fails_at - begin) / (end - begin);
  }
};

}  // namespace rotorub
