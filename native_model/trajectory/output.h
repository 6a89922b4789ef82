// The files of a run (contract: series.csv, impacts.csv, events.csv, summary.json), 17 significant
// digits, each written aside and renamed.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

void write_series(const Trajectory& trajectory, const std::filesystem::path& file);
void write_impacts(const Trajectory& trajectory, const std::filesystem::path& file);
void write_events(const Trajectory& trajectory, const std::filesystem::path& file);
// A file cannot be made where it was asked for: there is no such folder, or it may not be written
// to.
class UnwritablePlace : public std::runtime_error {
  using std::runtime_error::runtime_error;
};
// Writes `text` aside and renames it to `file`: whole or not at all. A device or a pipe is written
// as it is; a link stays one. Throws
// UnwritablePlace, and std::runtime_error where there is no room.
void write_whole(const std::filesystem::path& file, const std::string& text);

}  // namespace rotorub
