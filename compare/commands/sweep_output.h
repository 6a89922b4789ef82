// The files that `rotorub sweep` writes to its folder when all points are done, and the runs of
// single points.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "compare/commands/command.h"
#include "compare/sweep/folder.h"
#include "compare/sweep/sample.h"
#include "compare/sweep/shard.h"
#include "compare/sweep/store.h"

namespace rotorub {

struct SweepArguments : CommonOptions {
  std::string study, folder, shard;
  int jobs = 0, tasks = 0;  // 0 if not given
  bool slurm = false, bifurcation = false, branches = false;
  std::vector<std::string> merge;
  std::vector<std::int64_t> points;  // their runs are saved
};

// A study and the place of its results.
struct Sweep {
  sweep::Study study;
  std::unique_ptr<sweep::PointScenes> scenes;
  std::filesystem::path folder;
  int jobs = 1;

  sweep::Store store(const sweep::Shard& shard) const {
    return {folder / shard.file(), study, sweep::identity_of(*scenes), shard};
  }
};

// All files that the command may write to its folder.
std::vector<std::string> sweep_files(const SweepArguments& options, const Sweep& sweep);

// Writes the tables and the page; call it when all points are done.
void write_results(const SweepArguments& options, const Sweep& sweep, sweep::Store& store);

// Makes the runs of --point, each with its page in its own folder. Returns the exit code.
int keep_points(const SweepArguments& options, const Sweep& sweep);

}  // namespace rotorub
