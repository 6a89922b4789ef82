// The folder of a sweep: the study, the scene, the results of it or of its shards, and at the end
// results.csv and sweep.html.
#pragma once

#include <filesystem>

#include "compare/sweep/point_scene.h"
#include "compare/sweep/store.h"

namespace rotorub::sweep {

inline constexpr const char* kStudyFile = "study.toml";
inline constexpr const char* kSceneFile = "scene.toml";
inline constexpr const char* kCsvFile = "results.csv";
inline constexpr const char* kPageFile = "sweep.html";
inline constexpr const char* kDataFile =
    "sweep.json";  // what the page draws, for a report beside it

StudyIdentity identity_of(const PointScenes& scenes);

// Makes the folder and keeps study and scene in it, with the overrides of the command line. Throws
// StoreMismatch where there are results of another study.
void keep_study(const std::filesystem::path& folder, const PointScenes& scenes);

}  // namespace rotorub::sweep
