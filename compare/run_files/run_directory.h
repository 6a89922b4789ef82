// The folder of a run: series.csv, impacts.csv, events.csv, keyphasor.csv, columns.json (what their
// columns are), scene.toml and summary.json.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "compare/hdf5/module.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// The files that `plot` and `run --lyapunov` add to the folder.
inline constexpr const char* kRunPage = "plot.html";
inline constexpr const char* kLyapunovFile = "lyapunov.json";

// Makes the folder where it is missing and writes the files, each whole or not at all;
// summary.json comes last, so that it is never beside the series of another run. What an earlier
// run left in the folder is removed. Throws std::runtime_error naming the file.
// hdf5: writes run.h5 too (compare/run_files/hdf5_file.h); null: does not.
void write_run(const std::filesystem::path& folder, const scene::Scene& scene,
               const Trajectory& trajectory, hdf5::ImageOf hdf5 = nullptr);
// The files in folder / below that write_run writes there or removes, as names within `folder`.
// own_machine: the run is one of a machine of the user's own.
std::vector<std::string> run_files(const std::filesystem::path& folder,
                                   const std::string& below = "", bool own_machine = false);

// A folder that is not that of a run, or whose files have been changed since. what() names file and
// line.
class BrokenRun : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct StoredRun {
  scene::Scene scene;
  Trajectory trajectory;  // without statistics
};

// Reads what write_run wrote. Throws BrokenRun, or scene::SceneError, for anything else.
StoredRun read_run(const std::filesystem::path& folder);

// That the series is one to draw: has the columns that the contract promises, in ascending times,
// and no value that is none. Throws BrokenRun naming file, column and line.
void check_series(const Trajectory& trajectory, const std::string& file);

// Folder, within that of a MuJoCo run, of the native model that ran alongside ([mujoco] shadow): a
// run of its own.
inline constexpr const char* kShadowFolder = "shadow";

// That run; nothing where `run` has no shadow, or where the folder's is of another scene.
std::optional<StoredRun> read_shadow(const std::filesystem::path& folder, const StoredRun& run);

}  // namespace rotorub
