// Runs the points of a shard that have no result yet, on several threads, and stores what comes.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include "compare/sweep/sample.h"
#include "compare/sweep/store.h"

namespace rotorub::sweep {

// How far a sweep is.
struct SweepProgress {
  std::int64_t of = 0;         // points of the shard
  std::int64_t stored = 0;     // of them, by this call and those before it
  std::int64_t now = 0;        // of the stored ones, by this call
  std::optional<double> left;  // s, an estimate; nothing: no point has run yet
};

struct SweepOptions {
  int jobs = 1;  // threads, >= 1
  Shard shard;
  const std::atomic<bool>* interrupt = nullptr;  // true: stop; what is done is stored
  // Called about every tenth of a second, and at the end.
  std::function<void(const SweepProgress&)> progress;
};

// What is stored at a time is whole: a transaction holds full results of points. Some points that
// are spread over the shard run first, because they tell how long all take; the order changes no
// result. False: interrupted.
bool run_sweep(const PointScenes& scenes, Store& store, const SweepOptions& options);

}  // namespace rotorub::sweep
