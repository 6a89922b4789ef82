// The gap that a tracking law wants: from the one at switch-on smoothly to 0.
//
//   g_d = g_0 H_0(s) + T g_0' H_1(s),   s = (t - on) / T in [0, 1],
//
// with the quintics of value and slope, r = 1 - s: H_0 = r^3 (1 + 3 s + 6 s^2) and
// H_1 = r^3 s (1 + 3 s), whose first two derivatives are 0 at s = 1, and the second at s = 0 too.
// It is never below 0 for T g_0' >= -2.5 g_0; a gap that closes faster is met at that slope. One
// that opens is met at T g_0' <= 2.5 g_0, and 2.5 (delta_0 - g_0): as H_1 <= 0.198, the distance of
// the centres delta_0 - g_d that is asked for never falls below half of that at switch-on. Beyond
// the clearance it would be negative: no direction has it, and the ring would be held at the
// centre.
#pragma once

#include <algorithm>
#include <limits>

#include "native_model/control/controller.h"

namespace rotorub {

struct GapReference {
  double gap, rate, acceleration;  // m, m/s, m/s^2
  double share;                    // of the way done, H = 1 - H_0, in [0, 1]
};

// At t (s); time: T, s, > 0; clearance: delta_0, m.
inline GapReference gap_reference(const SwitchOn& on, double t, double time,
                                  double clearance = std::numeric_limits<double>::infinity()) {
  const double s = std::clamp((t - on.t) / time, 0.0, 1.0), r = 1.0 - s;
  const double cube = r * r * r;
  const double value = cube * (1.0 + 3.0 * s + 6.0 * s * s);
  const double fall = -30.0 * s * s * r * r, curve = -60.0 * s * r * (r - s);
  const double gap = std::max(on.gap, 0.0);
  const double most = std::clamp(clearance - gap, 0.0, gap);
  const double slope = std::clamp(time * on.gap_rate, -2.5 * gap, 2.5 * most);
  if (slope == 0.0)
    return {gap * value, gap * fall / time, gap * curve / (time * time), 1.0 - value};
  const double rise = cube * s * (1.0 + 3.0 * s);
  const double rise_rate = 1.0 - s * s * (18.0 - s * (32.0 - 15.0 * s));
  const double rise_curve = -s * (36.0 - s * (96.0 - 60.0 * s));
  return {gap * value + slope * rise, (gap * fall + slope * rise_rate) / time,
          (gap * curve + slope * rise_curve) / (time * time), 1.0 - value};
}

}  // namespace rotorub
