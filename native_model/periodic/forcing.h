// The loads that drive a motion, which decide the periods it may have. With the spin held,
// everything that turns with the rotor has the frequency Omega; forces of [[force]] have their own.
// If all frequencies are multiples of one, the period of the loads is known. A system without
// explicit time dependence is autonomous: the period of its motions is unknown. If its spin is free
// and something is fixed to the rotor, the spin angle grows by whole turns in a period.
//
// Controls of magnetic bearings that are sampled repeat with their sample time, which must divide
// the period of the loads. with_whole_samples() sees to this.
#pragma once

#include <string>

#include "native_model/model/model.h"

namespace rotorub::periodic {

struct Forcing {
  std::string refusal;  // the reason why no periodic motion is possible or supported, or empty
  double period = 0.0;  // s, > 0, of the loads; 0: autonomous
  bool turns = false;   // autonomous, and the spin angle grows by whole turns
  // s, >= 0, the time after which no load is switched any more; under loads a multiple of the
  // period.
  double settled = 0.0;
};

Forcing forcing_of(const Model& model);

// The model in which each sampled control has the sample time nearest to its own that divides the
// period of the loads, as if the clock of its processor ran a little faster or slower. Unchanged
// without loads.
Model with_whole_samples(Model model);

}  // namespace rotorub::periodic
