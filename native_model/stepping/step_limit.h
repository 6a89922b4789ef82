// The largest time step at which the fixed-step schemes are stable.
#pragma once

#include <string>

#include "native_model/model/model.h"

namespace rotorub {

struct StepLimit {
  double step = 0.0;    // s; infinity: no limit
  const char* of = "";  // the part that sets it
};

// The limit for everything that a fixed step takes explicitly from the state at its middle. For an
// explicit stiffness K and an explicit damping D on a mass m it is
//   h^2 K + 4 h D < 4 m   (leapfrog; D = 0: h < 2 / omega).
// It covers the springs of modes, bearings, ring and supports, the circulatory terms of bearings
// and of internal damping, the drive's integrator, the springs and dampers that a controller
// emulates, and compliant contacts with exponent 1. Damping of the model itself is implicit and
// sets no limit.
StepLimit step_limit(const Model& model);

// The reason why this step cannot work; empty if it can.
std::string step_refusal(const Model& model, double step);
// "step ... s is not below ... s, the limit of ...".
std::string step_limit_text(double step, const StepLimit& limit);

}  // namespace rotorub
