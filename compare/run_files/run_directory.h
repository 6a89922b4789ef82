// The folder of a run: series.csv, impacts.csv, events.csv, keyphasor.csv, columns.json (the
// meaning of their columns), scene.toml and summary.json.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "compare/hdf5/module.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Files that `plot` and `run --lyapunov` add to the folder.
inline constexpr const char* kRunPage = "plot.html";
inline constexpr const char* kLyapunovFile = "lyapunov.json";

// Creates the folder if it is missing and writes the files, each completely or not at all.
// summary.json is written last, so that it never stands beside the series of another run. Files of
// an earlier run are removed. Throws std::runtime_error that names the file. summary: by
// summary_json(). hdf5: if not null, also writes run.h5 (compare/run_files/hdf5_file.h).
void write_run(const std::filesystem::path& folder, const scene::Scene& scene,
               const Trajectory& trajectory, const nlohmann::json& summary,
               hdf5::ImageOf hdf5 = nullptr);
// The files that write_run writes or removes in folder / below, as names relative to `folder`.
// own_machine: for a run of a user's own machine.
std::vector<std::string> run_files(const std::filesystem::path& folder,
                                   const std::string& below = "", bool own_machine = false);

// The folder contains no run, or its files were changed. what() names file and line.
class BrokenRun : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct StoredRun {
  scene::Scene scene;
  Trajectory trajectory;     // without statistics
  nlohmann::json summary{};  // of summary.json
};

// Reads the output of write_run. Throws BrokenRun or scene::SceneError if it is not readable.
StoredRun read_run(const std::filesystem::path& folder);

// Checks that the series can be drawn: it must have the columns that the contract promises,
// ascending times and only finite values. Throws BrokenRun that names file, column and line.
void check_series(const Trajectory& trajectory, const std::string& file);

// Subfolder of a MuJoCo run for the native model that ran alongside ([mujoco] shadow), which is
// itself a run.
inline constexpr const char* kShadowFolder = "shadow";

// The shadow's run; empty if `run` has no shadow or the folder contains a different scene's.
std::optional<StoredRun> read_shadow(const std::filesystem::path& folder, const StoredRun& run);

}  // namespace rotorub
