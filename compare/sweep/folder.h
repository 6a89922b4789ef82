// The folder of a sweep: the study, the scene, the results of it or of its shards, and at the end
// results.csv and sweep.html.
#pragma once

#include <filesystem>

#include "compare/sweep/sample.h"
#include "compare/sweep/store.h"

namespace rotorub::sweep {

inline constexpr const char* kStudyFile = "study.toml";
inline constexpr const char* kSceneFile = "scene.toml";
inline constexpr const char* kPointsFile = "points.csv";  // of a list that has them in a file
inline constexpr const char* kCsvFile = "results.csv";
inline constexpr const char* kStatisticsFile = "statistics.csv";  // where [statistics] asks for it
inline constexpr const char* kPageFile = "sweep.html";
inline constexpr const char* kBifurcationFile = "bifurcation.json";
inline constexpr const char* kDataFile =
    "sweep.json";  // what the page draws, for a report beside it

StudyIdentity identity_of(const PointScenes& scenes);

// Makes the folder and keeps study and scene in it, with the overrides of the command line. Throws
// StoreMismatch where there are results of another study.
void keep_study(const std::filesystem::path& folder, const PointScenes& scenes);

// In double quotes where it has commas, quotes or line breaks (RFC 4180).
std::string csv_field(const std::string& text);

// The rows of a store as text, in the study's order: a header line, then one line a point;
// fields with commas, quotes or line breaks in double quotes (RFC 4180),
// nothing where there is no value. Whole or not at all.
void write_csv(Store& store, const std::filesystem::path& file);

}  // namespace rotorub::sweep
