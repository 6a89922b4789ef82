// Whole runs at a fixed step: steps, controllers, recorder, and the checks that end a run.
#pragma once

#include "native_model/model/model.h"
#include "native_model/run/run_native.h"

namespace rotorub {

// integrator: kEuler or kVerlet; step: s, > 0. Leaves the names, the step and the time of
// computation of the trajectory to run_native.
Trajectory run_fixed(scene::Integrator integrator, const Model& model, const scene::Run& run,
                     double step, const NativeOptions& options);

}  // namespace rotorub
