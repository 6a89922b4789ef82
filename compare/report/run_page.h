// The page of one run: its plots and its live player, as in the report.
#pragma once

#include <optional>
#include <string>

#include "compare/run_files/run_directory.h"

namespace rotorub {

// shadow: the native model that ran alongside, where there was one: the second run of the player.
std::string run_page(const StoredRun& run, const std::optional<StoredRun>& shadow);

}  // namespace rotorub
