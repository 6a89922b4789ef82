// Writes the files of a run (by contract series.csv, impacts.csv, events.csv, summary.json; also
// keyphasor.csv). Each is written to a temporary file and renamed.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Appends the number in the format of all CSV files: the shortest decimal that reads back to the
// same bits, with at most 17 significant digits, "0.0003", "1e-09". Zero has no sign.
void append_number(std::string& text, double value);

void write_series(const Trajectory& trajectory, const std::filesystem::path& file);
void write_impacts(const Trajectory& trajectory, const std::filesystem::path& file);
void write_events(const Trajectory& trajectory, const std::filesystem::path& file);
void write_keyphasor(const Trajectory& trajectory, const std::filesystem::path& file);
// A file cannot be created in the requested place, because there is no such folder or it is not
// writable.
class UnwritablePlace : public std::runtime_error {
  using std::runtime_error::runtime_error;
};
// Writes `text` to a temporary file and renames it to `file`, so that the file is complete or
// absent. Creates the folder if necessary. A device or a pipe is written directly; a link stays a
// link. Throws UnwritablePlace, or std::runtime_error if there is no space left.
void write_whole(const std::filesystem::path& file, const std::string& text);

// Creates and returns the temporary file in which `file` is written until it is complete:
// `<file>.part-<process>-<machine>-<random>`, new and empty; creates its folder if necessary.
// Removes temporary files of the same file that ended processes of this machine have left behind.
std::filesystem::path part_of(const std::filesystem::path& file);

// Checks that files can be created in the folder, or in the nearest existing one above it, by
// creating one. Throws std::filesystem::filesystem_error, so that a run of hours does not fail only
// when it writes its results.
void check_writable(const std::filesystem::path& folder);

}  // namespace rotorub
