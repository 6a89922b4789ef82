// A magnetic bearing that holds the rotor by a feedback of its own, on one axis: the linear magnet
// and a proportional-integral-derivative law (Schweitzer, Maslen: Magnetic Bearings, 2009, chapters
// 2 and 4), r the deflection at its station, s that at its sensor's, i the control current beyond
// the bias, j the part of it that the integrator holds,
//
//   u = -(P s + D s' + j),   i = clamp(u, -limit, limit),
//   F = k_s r + k_i i,       j' = I s + (u - i) I / P
//
// for t < fails_at; from then on i = 0, F = 0 and j stays. The last term takes back from j within
// the integral's own time P / I what the limit cuts off (K. J. Astrom, T. Hagglund, "PID
// Controllers", 1995, section 3.5: back-calculation), or j would grow for as long as the rotor lies
// in its ring. Without the integrator and with s = r the linear law is a spring k_i P - k_s and a
// damper k_i D. A model has that spring for all time (the modes' stiffness, the stored energy), and
// here what F is beyond it.
#pragma once

#include "native_model/numerics/lanes.h"

namespace rotorub {

template <class T>
struct MagneticFeedback {
  T negative_stiffness{};          // N/m, k_s >= 0
  T force_per_current{};           // N/A, k_i > 0
  T proportional{}, derivative{};  // A/m, A s/m, P, D >= 0
  T current_limit{};               // A, > 0, infinity: none
  T fails_at{};                    // s, >= 0
  T held{};                        // N/m: a spring that others have for it, taken back here
  T integral{};                    // A/(m s), I >= 0; with P = 0 only 0

  T stiffness() const { return force_per_current * proportional - negative_stiffness; }  // N/m
  T damping() const { return force_per_current * derivative; }                           // N s/m

  // u and i, A, while it works; seen, rate: s, s'; stored: j.
  ROTORUB_INLINE T asked(const T& seen, const T& rate, const T& stored) const {
    return -(proportional * seen + derivative * rate + stored);
  }
  ROTORUB_INLINE T limited(const T& asked) const {
    const T capped = lanes::select(asked > current_limit, current_limit, asked);
    return lanes::select(capped < -current_limit, -current_limit, capped);
  }
  ROTORUB_INLINE T current(const T& seen, const T& rate, const T& stored) const {
    return limited(asked(seen, rate, stored));
  }
  // N, what it does beyond the spring `held`, working for `share` of the time, in [0, 1].
  ROTORUB_INLINE T force(const T& share, const T& r, const T& seen, const T& rate,
                         const T& stored) const {
    return held * r +
           share * (negative_stiffness * r + force_per_current * current(seen, rate, stored));
  }
  // j', A/s; with an integrator only.
  ROTORUB_INLINE T stored_rate(const T& share, const T& seen, const T& rate,
                               const T& stored) const {
    const T u = asked(seen, rate, stored);
    return share * integral * (seen + (u - limited(u)) / proportional);
  }
  // The share of the time from begin to end (s) for which it works; of an instant 0 or 1.
  static double working(double fails_at, double begin, double end) {
    if (begin >= fails_at) return 0.0;
    return end <= fails_at ? 1.0 : (fails_at - begin) / (end - begin);
  }
};

}  // namespace rotorub
