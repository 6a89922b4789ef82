// Runs the points of a shard that have no result yet, on several threads, and stores what comes.
#pragma once

#include <atomic>
#include <functional>

#include "compare/sweep/sample.h"
#include "compare/sweep/store.h"

namespace rotorub::sweep {

struct SweepOptions {
  int jobs = 1;  // threads, >= 1
  Shard shard;
  const std::atomic<bool>* interrupt = nullptr;  // true: stop; what is done is stored
  // Of the shard's `of` points so many are stored, and so many of those by this call.
  std::function<void(std::int64_t stored, std::int64_t of, std::int64_t now)> progress;
};

// Points that are run, and handed on, at a time: enough to fill ensembles, or one.
Batches batches_of(const PointScenes& scenes);

// What is stored at a time is whole: a transaction holds full results of points. False:
// interrupted.
bool run_sweep(const PointScenes& scenes, Store& store, const SweepOptions& options);

}  // namespace rotorub::sweep
