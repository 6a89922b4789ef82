// A sweep beyond one machine: an array job of Slurm, each of whose tasks runs a shard.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/sweep/shard.h"

namespace rotorub::sweep {

struct SlurmJob {
  std::filesystem::path program;  // absolute, as the nodes see them all
  std::filesystem::path study, folder;
  int tasks = 1;                       // shards
  int jobs = 1;                        // processors of a task, and threads
  std::vector<std::string> overrides;  // --set
  bool allow_library = false;  // the tasks may open the scene's library, as the user said here
};

inline constexpr const char* kSlurmFile = "sweep.sbatch";

// The script: it can be submitted again for some tasks, as by sbatch --array=3 sweep.sbatch.
std::string slurm_script(const SlurmJob& job);

// Submits the script for these tasks; the number of the job. Throws std::runtime_error with what
// sbatch says.
std::string submit(const std::filesystem::path& script, const std::vector<int>& tasks);

// "'it'\''s'", "$'two\x0alines'": one word of bash, on one line.
std::string shell_word(const std::string& text);

}  // namespace rotorub::sweep
