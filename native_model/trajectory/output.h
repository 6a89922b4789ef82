// The files of a run (contract: series.csv, impacts.csv, events.csv, summary.json; keyphasor.csv),
// each written aside and renamed.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// The number as all CSV files have it: the shortest decimal that reads back to the same bits, 17
// significant digits at most, "0.0003", "1e-09". A zero has no sign.
void append_number(std::string& text, double value);

void write_series(const Trajectory& trajectory, const std::filesystem::path& file);
void write_impacts(const Trajectory& trajectory, const std::filesystem::path& file);
void write_events(const Trajectory& trajectory, const std::filesystem::path& file);
void write_keyphasor(const Trajectory& trajectory, const std::filesystem::path& file);
// A file cannot be made where it was asked for: there is no such folder, or it may not be written
// to.
class UnwritablePlace : public std::runtime_error {
  using std::runtime_error::runtime_error;
};
// Writes `text` aside and renames it to `file`: whole or not at all, in a folder that is made if
// need be. A device or a pipe is written as it is; a link stays one. Throws UnwritablePlace, and
// std::runtime_error where there is no room.
void write_whole(const std::filesystem::path& file, const std::string& text);

// The place beside a file where it is written until it is whole:
// `<file>.part-<process>-<machine>-<random>`, a file that was not there and is empty now, as its
// folder may be. What
// ended processes of this machine left of the same file is removed.
std::filesystem::path part_of(const std::filesystem::path& file);

// Checks that files can be created in the folder, or in the nearest existing one above it, by
// creating one. Throws std::filesystem::filesystem_error, so that a run of hours does not fail only
// when it writes its results.
void check_writable(const std::filesystem::path& folder);

}  // namespace rotorub
