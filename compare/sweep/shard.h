// A part of a study's points: shard i of n has every n-th.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rotorub::sweep {

struct Shard {
  int number = 1, count = 1;  // number in [1, count]

  bool whole() const { return count == 1; }
  // How many of a study's points it has.
  std::int64_t points_of(std::int64_t all) const { return (all - number + count) / count; }
  std::string file() const;  // of its results: results.sqlite, or results.2-of-4.sqlite
};

inline constexpr int kMostShards = 10000;

// "2/4". Throws std::invalid_argument with what is accepted.
Shard parse_shard(const std::string& text);

// A sweep beyond one machine: an array job of Slurm, each of whose tasks runs a shard.
struct SlurmJob {
  std::filesystem::path program;  // absolute, as the nodes see them all
  std::filesystem::path study, folder;
  int tasks = 1;                       // shards
  int jobs = 1;                        // processors of a task, and threads
  std::vector<std::string> overrides;  // --set
  bool allow_library = false;  // the tasks may open the scene's library, as the user said here
};

inline constexpr const char* kSlurmFile = "sweep.sbatch";

// A text as one word of bash, on one line: "'it'\\''s'", "$'two\\x0alines'".
std::string shell_word(const std::string& text);

// The script: it can be submitted again for some tasks, as by sbatch --array=3 sweep.sbatch.
std::string slurm_script(const SlurmJob& job);

// Submits the script for these tasks; the number of the job. Throws std::runtime_error with what
// sbatch says.
std::string submit(const std::filesystem::path& script, const std::vector<int>& tasks);

}  // namespace rotorub::sweep
