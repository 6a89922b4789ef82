// A whole run of `verlet` with several contacts (stepping/coupled_verlet.h).
#pragma once

#include "native_model/run/run_native.h"
#include "native_model/system/model.h"

namespace rotorub {

Trajectory run_several_contacts(const Model& model, const scene::Run& run, double step,
                                const NativeOptions& options);

}  // namespace rotorub
