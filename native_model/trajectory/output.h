// The files of a run (contract: series.csv, impacts.csv, events.csv, summary.json), 17 significant
// digits, each written aside and renamed.
#pragma once

#include <filesystem>
#include <string>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

void write_series(const Trajectory& trajectory, const std::filesystem::path& file);
void write_impacts(const Trajectory& trajectory, const std::filesystem::path& file);
void write_events(const Trajectory& trajectory, const std::filesystem::path& file);
// Writes `text` aside and renames it to `file`: whole or not at all. A device or a pipe is written
// as it is; a link stays one. Throws std::runtime_error.
void write_whole(const std::filesystem::path& file, const std::string& text);

}  // namespace rotorub
