// A run as the page's scripts have it, whoever made it: the program, or the native model in the
// page itself (compare/live).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"
#include "renders/machine.h"

namespace rotorub {

// {"label", "end", "status", "tracks" (pack/packed_run.h; empty without a machine), "whirl"
// (whirl_plots.h), and of each contact "impacts" on their laws and "distribution"
// (contact_plots.h)}. first: the run that others are measured against, null for itself. limit: Hz,
// of spectra.
nlohmann::json run_data(const scene::Scene& scene, const std::string& label, const Trajectory& run,
                        const Trajectory* first, const renders::Machine* machine, double limit);

}  // namespace rotorub
