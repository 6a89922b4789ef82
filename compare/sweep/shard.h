// A part of a study's points: shard i of n has every n-th point.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rotorub::sweep {

struct Shard {
  int number = 1, count = 1;  // number in [1, count]

  bool whole() const { return count == 1; }
  // The number of its points.
  std::int64_t points_of(std::int64_t all) const { return (all - number + count) / count; }
  std::string file() const;  // of its results: results.sqlite, or results.2-of-4.sqlite
};

inline constexpr int kMostShards = 10000;

// Reads "2/4". Throws std::invalid_argument with the accepted forms.
Shard parse_shard(const std::string& text);

// A sweep on a cluster: an array job of Slurm in which each task runs one shard.
struct SlurmJob {
  std::filesystem::path program;  // absolute, the same path on all nodes
  std::filesystem::path study, folder;
  int tasks = 1;                       // shards
  int jobs = 1;                        // processors and threads per task
  std::vector<std::string> overrides;  // --set
  // Whether the tasks may open the scene's library, as the user allowed here.
  bool allow_library = false;
};

inline constexpr const char* kSlurmFile = "sweep.sbatch";

// A text as a single word of bash, on one line: "'it'\\''s'", "$'two\\x0alines'".
std::string shell_word(const std::string& text);

// The script. It can be resubmitted for some tasks, as by sbatch --array=3 sweep.sbatch.
std::string slurm_script(const SlurmJob& job);

// Submits the script for these tasks and returns the number of the job. Throws std::runtime_error
// with the message of sbatch.
std::string submit(const std::filesystem::path& script, const std::vector<int>& tasks);

}  // namespace rotorub::sweep
