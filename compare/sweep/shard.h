// A part of a study's points: shard i of n has every n-th batch. Which points are in a batch
// depends on the study alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rotorub::sweep {

struct Shard {
  int number = 1, count = 1;  // number in [1, count]

  bool whole() const { return count == 1; }
  bool has(std::int64_t batch) const { return batch % count == number - 1; }
  std::string file() const;  // of its results: results.sqlite, or results.2-of-4.sqlite
};

inline constexpr int kMostShards = 10000;

// "2/4". Throws std::invalid_argument with what is accepted.
Shard parse_shard(const std::string& text);

// Points of each batch: `size` of them, the last one the rest.
struct Batches {
  std::int64_t points = 0, size = 1;
  std::int64_t count() const { return (points + size - 1) / size; }
  std::int64_t begin(std::int64_t batch) const { return batch * size; }
  std::int64_t end(std::int64_t batch) const {
    return points < (batch + 1) * size ? points : (batch + 1) * size;
  }
  std::int64_t points_of(const Shard& shard) const;
};

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
