// A magnetic bearing that holds the rotor by a feedback of its own, on one axis: a magnet, an
// amplifier and a proportional-integral-derivative law (Schweitzer, Maslen: Magnetic Bearings,
// 2009, chapters 2 to 4), r the deflection at its station, s that at its sensor's, i the control
// current beyond the bias, j the part of it that the integrator holds, d the filtered rate,
//
//   u = -(P s + D d + j),   T_d d' = s' - d,   c = clamp(u, -limit, limit),
//   T_a i' = c - i within the voltage (bearing/coil.h),   j' = I s + (u - c) I / P,
//   F = k_s r + k_i i, or that of two magnets, F(r, i) (bearing/opposed_magnets.h)
//
// while it works; while it does not c = 0, F = 0 and j stays. Without a filter d = s', without a
// lag i = c. The last term of j' takes back within the integral's own time P / I what the limit
// cuts off (K. J. Astrom, T. Hagglund, "PID Controllers", 1995, section 3.5: back-calculation), or
// j would grow for as long as the rotor lies in its ring. Without integrator, filter and lag and
// with s = r the linear law is a spring k_i P - k_s and a damper k_i D. A model has that spring for
// all time (the modes' stiffness, the stored energy), and here what F is beyond it.
#pragma once

#include <algorithm>
#include <array>

#include "native_model/bearing/coil.h"
#include "native_model/bearing/opposed_magnets.h"

namespace rotorub {

// It works for from <= t < fails and for returns <= t; s.
struct WorkingTimes {
  double from, fails, returns;

  std::array<double, 3> all() const { return {from, fails, returns}; }
  bool at(double t) const { return t >= returns || (t >= from && t < fails); }
  // The share of the time from begin to end for which it works; of an instant 0 or 1.
  double share(double begin, double end) const {
    if (!(end > begin)) return at(begin) ? 1.0 : 0.0;
    const auto within = [&](double on, double off) {
      const double first = on > begin ? on : begin, last = off < end ? off : end;
      return last > first ? last - first : 0.0;
    };
    const double again = returns > fails ? returns : fails;
    return (within(from, fails) + within(again, end)) / (end - begin);
  }
};

struct MagneticFeedback {
  double negative_stiffness = 0.0;  // N/m, k_s >= 0; of two magnets that about the middle
  double force_per_current = 0.0;   // N/A, k_i > 0; likewise
  double proportional = 0.0;        // A/m, P >= 0
  double derivative = 0.0;          // A s/m, D >= 0
  double current_limit = 0.0;       // A, > 0, infinity: none
  double held = 0.0;                // N/m: a spring that others have for it, taken back here
  double integral = 0.0;            // A/(m s), I >= 0; with P = 0 only 0
  double derivative_lag = 0.0;      // s, T_d >= 0
  Coil amplifier{};
  bool opposed = false;  // F(r, i) of `magnets`
  OpposedMagnets magnets{};

  double stiffness() const {  // N/m
    return force_per_current * proportional - negative_stiffness;
  }
  double damping() const { return force_per_current * derivative; }  // N s/m

  // u and c, A, while it works; seen, rate: s, d; stored: j.
  double asked(double seen, double rate, double stored) const {
    return -(proportional * seen + derivative * rate + stored);
  }
  double limited(double asked) const {
    return std::max(std::min(asked, current_limit), -current_limit);
  }
  // N, what it does beyond the spring `held`, working for `share` of the time, in [0, 1].
  double force(double share, double r, double current) const {
    if (opposed) return held * r + share * magnets.force(r, current);
    return held * r + share * (negative_stiffness * r + force_per_current * current);
  }
  // j', A/s; with an integrator only.
  double stored_rate(double share, double seen, double asked) const {
    return share * integral * (seen + (asked - limited(asked)) / proportional);
  }
};

}  // namespace rotorub
