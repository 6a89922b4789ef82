// One axis of a magnetic bearing that carries the rotor by its own feedback: a magnet, an amplifier
// and a proportional-integral-derivative law (Schweitzer, Maslen: Magnetic Bearings, 2009, chapters
// 2 to 4). With r the deflection at the station, s the deflection at the sensor, i the control
// current beyond the bias, j the integrator's part of it and d the filtered rate,
//
//   u = -(P s + D d + j),   T_d d' = s' - d,   c = clamp(u, -limit, limit),
//   T_a i' = c - i within the voltage (bearing/coil.h),   j' = I s + (u - c) I / P,
//   F = k_s r + k_i i, or F(r, i) of two magnets (bearing/opposed_magnets.h)
//
// while the bearing works. Otherwise c = 0, F = 0 and j is constant. Without a filter d = s',
// without a lag i = c. The last term of j' removes within the integral time P / I what the limit
// cuts off (K. J. Astrom, T. Hagglund, "PID Controllers", 1995, section 3.5: back-calculation);
// without it j would grow for as long as the rotor lies in its ring. Without integrator, filter and
// lag, and with s = r, the linear law is a spring k_i P - k_s and a damper k_i D. The model
// contains this spring at all times (stiffness of the modes, stored energy), and this part adds the
// rest of F.
#pragma once

#include <algorithm>
#include <array>

#include "native_model/bearing/coil.h"
#include "native_model/bearing/opposed_magnets.h"

namespace rotorub {

// The bearing works for from <= t < fails and for t >= returns; s.
struct WorkingTimes {
  double from, fails, returns;

  std::array<double, 3> all() const { return {from, fails, returns}; }
  bool at(double t) const { return t >= returns || (t >= from && t < fails); }
  // Fraction of the time from begin to end in which the bearing works; 0 or 1 for an instant.
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
  double negative_stiffness = 0.0;  // N/m, k_s >= 0; for two magnets, linearised about the centre
  double force_per_current = 0.0;   // N/A, k_i > 0; likewise
  double proportional = 0.0;        // A/m, P >= 0
  double derivative = 0.0;          // A s/m, D >= 0
  double current_limit = 0.0;       // A, > 0, infinity: none
  double linear_spring = 0.0;       // N/m, spring of this bearing in the model, subtracted here
  double integral = 0.0;            // A/(m s), I >= 0; with P = 0 only 0
  double derivative_lag = 0.0;      // s, T_d >= 0
  Coil amplifier{};
  bool opposed = false;  // the force is F(r, i) of `magnets`
  OpposedMagnets magnets{};

  double stiffness() const {  // N/m
    return force_per_current * proportional - negative_stiffness;
  }
  double damping() const { return force_per_current * derivative; }  // N s/m

  // u and c, A, while the bearing works. deflection, rate: s, d; stored: j.
  double asked(double deflection, double rate, double stored) const {
    return -(proportional * deflection + derivative * rate + stored);
  }
  double limited(double asked) const {
    return std::max(std::min(asked, current_limit), -current_limit);
  }
  // N, force beyond the spring `linear_spring`, if the bearing works for the fraction `share` of
  // the time.
  double force(double share, double r, double current) const {
    if (opposed) return linear_spring * r + share * magnets.force(r, current);
    return linear_spring * r + share * (negative_stiffness * r + force_per_current * current);
  }
  // j', A/s; only with an integrator, because it divides by P.
  double stored_rate(double share, double deflection, double asked) const {
    return share * integral * (deflection + (asked - limited(asked)) / proportional);
  }
};

}  // namespace rotorub
