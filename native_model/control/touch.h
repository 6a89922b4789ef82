// Whether rotor and ring have touched since the sample before, from what the sensors show: the gap
// is closed now (to 1e-5 of the clearance, so that contact that lasts already when a trigger is
// armed is a touch at once, in every engine alike), or it would have closed on its way from the
// last sample to this one, at the rate that it had.
#pragma once

#include <cstddef>

#include "native_model/control/controller.h"

namespace rotorub {

struct SeenGap {
  double gap = 0.0, rate = 0.0;  // m, m/s
};
// A centred rotor's gap does not close.
SeenGap seen_gap(const Measurement& now, double clearance);

// state: kTouchState numbers, 0 before the first sample.
inline constexpr std::size_t kTouchState = 2;
bool touched(const Measurement& now, double clearance, double* state);

}  // namespace rotorub
