// A run in the format of the page's scripts, computed by the program or by the native model in the
// page itself (compare/report/live).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"
#include "renders/machine.h"

namespace rotorub {

// {"label", "end", "status", "message" (why it ended early), "engine", "integrator", "contact",
// "step", "steps", "rows", "impacts_written" (all of impacts.csv), "tracks" (pack/packed_run.h;
// empty without a machine), "whirl" (whirl_plots.h), for each contact "impacts" on their laws, and
// "longest_impact": s, with a soft contact, whose longer episodes are rubs; null if every episode
// is an impact}. first: the run that others are compared with, null for itself. limit: of the
// spectra, Hz.
nlohmann::json run_data(const scene::Scene& scene, const std::string& label, const Trajectory& run,
                        const Trajectory* first, const renders::Machine* machine, double limit);

}  // namespace rotorub
