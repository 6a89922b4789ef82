// The loads that drive a motion, which decide the periods it may have. With the spin held,
// everything that turns with the rotor has the frequency Omega; forces of [[force]] have their own.
// If all frequencies are multiples of one, the period of the loads is known. A system without
// explicit time dependence is autonomous: the period of its motions is unknown. If its spin is free
// and something is fixed to the rotor, the spin angle grows by whole turns in a period.
//
// Sampled controls repeat with their sample time, which must divide the period of the loads;
// prepare/repeating_model.h sees to this.
#pragma once

#include <string>
#include <vector>

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

// s, of all sampled controls, those of magnetic bearings before those of rings.
std::vector<double> sample_times(const Model& model);

// s, > 0, the period in which all loads that act for ever repeat; 0 if there is none.
double period_of_loads(const Model& model);
// s, > 0: the sample time nearest to this one that divides a period (s). This one itself if it
// would change by more than a tenth.
double whole_sample_time(double sample_time, double period);

// s, >= t: the middle of the longest time without samples soon after t (s); t if nothing is
// sampled. Runs and periods begin and end there, so that round-off does not decide on which side a
// sample is.
double between_samples(const Model& model, double t);

}  // namespace rotorub::periodic
