// Runs the points of a shard that have no result yet, on several threads, and stores the results.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include "compare/sweep/sample.h"
#include "compare/sweep/store.h"

namespace rotorub::sweep {

// The progress of a sweep.
struct SweepProgress {
  std::int64_t of = 0;         // number of points of the shard
  std::int64_t stored = 0;     // number of stored ones, by this call and earlier ones
  std::int64_t now = 0;        // number of points stored by this call
  std::optional<double> left;  // s, an estimate; empty until a point has run
};

struct SweepOptions {
  int jobs = 1;  // threads, >= 1
  Shard shard;
  const std::atomic<bool>* interrupt = nullptr;  // true: stop and keep what is stored
  // Called about ten times per second, and at the end.
  std::function<void(const SweepProgress&)> progress;
};

// Each transaction stores complete results of points. Some points spread over the shard run first,
// to estimate the time of all points; the order does not affect the results. Returns false if
// interrupted.
bool run_sweep(const PointScenes& scenes, Store& store, const SweepOptions& options);

}  // namespace rotorub::sweep
