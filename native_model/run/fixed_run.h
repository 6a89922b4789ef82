// Whole runs of the fixed steps: steps, controller, recorder, and the checks that end a run.
#pragma once

#include "native_model/run/run_native.h"
#include "native_model/system/model.h"

namespace rotorub {

Trajectory run_paper(const Model& model, const scene::Run& run, double step,
                     const NativeOptions& options);
Trajectory run_literal(const Model& model, const scene::Run& run, double step,
                       const NativeOptions& options);
Trajectory run_verlet(const Model& model, const scene::Run& run, double step,
                      const NativeOptions& options);

}  // namespace rotorub
