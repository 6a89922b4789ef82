// The folder of a sweep: the study, the scene, the results of the study or of its shards, and
// finally results.csv and sweep.html.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/sweep/sample.h"
#include "compare/sweep/store.h"

namespace rotorub::sweep {

inline constexpr const char* kStudyFile = "study.toml";
inline constexpr const char* kSceneFile = "scene.toml";
inline constexpr const char* kPointsFile = "points.csv";  // for a list whose points are in a file
inline constexpr const char* kCsvFile = "results.csv";
inline constexpr const char* kStatisticsFile = "statistics.csv";  // if [statistics] requests it
inline constexpr const char* kPageFile = "sweep.html";
inline constexpr const char* kBifurcationFile = "bifurcation.json";
inline constexpr const char* kDataFile =
    "sweep.json";  // the data of the page, for a report beside it

StudyIdentity identity_of(const PointScenes& scenes);

// Creates the folder and saves study and scene in it, with the overrides of the command line.
// Throws StoreMismatch if the folder holds results of another study.
void keep_study(const std::filesystem::path& folder, const PointScenes& scenes);

std::string csv_number(const std::optional<double>& value);  // empty without a value
// Texts that contain commas, quotes or line breaks are put in double quotes (RFC 4180).
std::string csv_line(const std::vector<std::string>& texts);

// Writes the rows of a store as text in the study's order: a header line, then one line per point.
// Missing values are empty fields. The file is written completely or not at all.
void write_csv(Store& store, const std::filesystem::path& file);

}  // namespace rotorub::sweep
