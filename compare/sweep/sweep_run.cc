#include "compare/sweep/sweep_run.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <utility>

#include "compare/engine/mujoco_model.h"
#include "compare/sweep/batch_run.h"
#include "compare/sweep/exchange.h"
#include "plugin/hooks.h"

namespace rotorub::sweep {
namespace {

using namespace std::chrono_literals;
constexpr auto kStoreEvery = 100ms;  // a transaction waits for the disk

// The batches of the shard, handed out in order.
class Work {
 public:
  Work(const Batches& batches, const Shard& shard, std::vector<bool> done)
      : batches_(batches), shard_(shard), done_(std::move(done)), next_(shard.number - 1) {}

  // The points of the next batch that are still to do; nothing: no batch is left.
  std::optional<std::vector<std::int64_t>> next() {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (; next_ < batches_.count(); next_ += shard_.count) {
      std::vector<std::int64_t> points;
      for (std::int64_t p = batches_.begin(next_); p < batches_.end(next_); ++p) {
        if (!done_[static_cast<std::size_t>(p)]) points.push_back(p);
      }
      if (points.empty()) continue;
      next_ += shard_.count;
      return points;
    }
    return std::nullopt;
  }

 private:
  std::mutex mutex_;
  Batches batches_;
  Shard shard_;
  std::vector<bool> done_;
  std::int64_t next_;
};

// MuJoCo's callbacks and handlers are global: they stay in place while any thread steps.
struct MujocoInPlace {
  MujocoMessages messages;
  plugin::Hooks hooks;
};

}  // namespace

Batches batches_of(const PointScenes& scenes) {
  return {scenes.sample().size(), batch_size(scenes.study())};
}

bool run_sweep(const PointScenes& scenes, Store& store, const SweepOptions& options) {
  const Batches batches = batches_of(scenes);
  std::vector<bool> done = store.done();
  const std::int64_t of = batches.points_of(options.shard);
  std::int64_t stored = std::count(done.begin(), done.end(), true), now = 0;
  Work work(batches, options.shard, std::move(done));
  Exchange exchange;
  std::atomic<bool> stop{false};
  std::optional<MujocoInPlace> mujoco;
  if (scenes.study().engine == EngineKind::kMujoco) mujoco.emplace();

  const BatchRun batch(
      scenes.study(), [&](std::int64_t point) { return scenes.at(point); }, stop);
  const auto loop = [&] {
    while (!stop) {
      const auto points = work.next();
      if (!points) return;
      exchange.put(batch.run(*points));
    }
  };
  bool ended = false;
  {
    const Workers workers(options.jobs, loop, exchange, stop);
    while (!ended) {
      if (options.interrupt && *options.interrupt) stop = true;
      const std::vector<PointResult> results = exchange.take(kStoreEvery, ended);
      if (!results.empty()) store.add(results, scenes.sample());
      stored += static_cast<std::int64_t>(results.size());
      now += static_cast<std::int64_t>(results.size());
      if (options.progress) options.progress(stored, of, now);
    }
  }
  exchange.rethrow();
  return stored == of;
}

}  // namespace rotorub::sweep
