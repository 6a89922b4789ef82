// A measured run in a page: one more run of the plots and the player, of what its record has and
// nothing else, and the tables beside them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "compare/report/plots.h"

namespace rotorub {

inline constexpr const char* kMeasured = "measured";  // its label, and its colour in the page

// As the other sides of plot_data(), with {"measured": true, "start", "holes", "absent"}: tracks
// only of what is measured, straight between samples and no more than 50,000 of them; holes: of
// each track, where the record has none ([from, to], s), which the plots leave open; absent: a
// sentence on what the player cannot show. Without shown.measured null. limit: Hz, of its
// spectrum.
nlohmann::json measured_side(const ShownRuns& shown, double limit);

// The track of the contact's force of the k-th run averaged over the record's samples, as
// track_json(); null where none is measured.
nlohmann::json sampled_force(const ShownRuns& shown, std::size_t run);

// For {{measured}} of report.html: texts, worded and rounded; null without one.
nlohmann::json measured_values(const std::optional<MeasuredRun>& run);

}  // namespace rotorub
