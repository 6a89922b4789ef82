// The largest step at which the fixed steps are stable.
#pragma once

#include <string>

#include "native_model/model/model.h"

namespace rotorub {

struct StepLimit {
  double step = 0.0;    // s; infinity: none
  const char* of = "";  // what sets it
};

// Of everything that a fixed step takes from the state at its middle: with stiffness K and damping
// D that are explicit, and damping C that is implicit, on a mass m,
//   h^2 K + 2 h D < 4 (m + ...)   (leapfrog; D = 0: h < 2 / omega).
// Springs of modes, bearings and ring, springs and dampers that a controller emulates, magnets.
// Damping of the model itself is implicit and sets no limit.
StepLimit step_limit(const Model& model);

// Empty, or why the step cannot work, with the limit.
std::string step_refusal(const Model& model, double step);
// "step ... s is not below ... s, the limit of ...".
std::string step_beyond(double step, const StepLimit& limit);

}  // namespace rotorub
