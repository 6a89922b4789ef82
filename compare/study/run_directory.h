// The folder of a run: series.csv, impacts.csv, events.csv, scene.toml and summary.json.
#pragma once

#include <filesystem>
#include <optional>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Makes the folder where it is missing and writes the files, each whole or not at all;
// summary.json comes last, so that it is never beside the series of another run. Throws
// std::runtime_error naming the file.
void write_run(const std::filesystem::path& folder, const scene::Scene& scene,
               const Trajectory& trajectory);

struct StoredRun {
  scene::Scene scene;
  Trajectory trajectory;  // without statistics
};

// Reads what write_run wrote. Throws std::runtime_error naming file and line for anything else.
StoredRun read_run(const std::filesystem::path& folder);

// Folder, within that of a MuJoCo run, of the native model that ran alongside ([mujoco] shadow): a
// run of its own.
inline constexpr const char* kShadowFolder = "shadow";

// That run; nothing where `run` has no shadow, or where the folder's is of another scene.
std::optional<StoredRun> read_shadow(const std::filesystem::path& folder, const StoredRun& run);

}  // namespace rotorub
