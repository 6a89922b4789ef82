// A measured run in a page: a further run in plots and player, with only the record's data.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "compare/report/plots.h"

namespace rotorub {

// Its label, which selects its colour in the page.
inline constexpr const char* kMeasured = "measured";

// {"label", "measured": true, "start", "end", "tracks", "holes", "whirl": "spectrum" and "residual"
// of whirl_plots.h}. The tracks contain only measured quantities, linear between at most 50,000
// samples. holes: for each track the gaps of the record ([from, to], s), which the plots leave
// open. null without shown.measured. limit: of its spectrum, Hz.
nlohmann::json measured_side(const ShownRuns& shown, double limit);

// The track of the contact force in the run of this label, averaged over the record's samples, in
// the format of track_json(); null if the force was not measured, and for a run that the record was
// not compared with.
nlohmann::json sampled_force(const ShownRuns& shown, const std::string& label);

}  // namespace rotorub
