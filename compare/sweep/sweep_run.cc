#include "compare/sweep/sweep_run.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "compare/engine/mujoco_messages.h"
#include "compare/sweep/ensemble_points.h"
#include "compare/sweep/exchange.h"
#include "compare/sweep/single_point.h"
#include "plugin/hooks.h"

namespace rotorub::sweep {
namespace {

using namespace std::chrono_literals;
constexpr std::int64_t kEnsemblePoints = 32;  // of a batch: whole groups on every instruction set
constexpr auto kStoreEvery = 100ms;           // a transaction waits for the disk

// Of a batch: those that can go into ensembles do, the others run by themselves.
class BatchRun {
 public:
  BatchRun(const PointScenes& scenes, const std::atomic<bool>& interrupt)
      : scenes_(scenes), interrupt_(interrupt) {}

  std::vector<PointResult> run(const std::vector<std::int64_t>& points) const {
    std::vector<PointResult> out;
    std::map<scene::Integrator, std::vector<PointScene>> together;
    for (const std::int64_t point : points) {
      if (interrupt_) return {};
      try {
        PointScene made{point, scenes_.at(point)};
        const Study& study = scenes_.study();
        const auto integrator = study.integrator.value_or(made.scene.run.integrator);
        if (study.engine == EngineKind::kNative && has_ensemble(integrator)) {
          together[integrator].push_back(std::move(made));
        } else if (auto result = run_single(point, made.scene, *engine_of(study, made.scene),
                                            interrupt_)) {
          out.push_back(std::move(*result));
        }
      } catch (const scene::SceneError& error) {
        out.push_back(refused(point, reason_of(error)));
      }
    }
    for (const auto& [integrator, members] : together) {
      for (PointResult& result : run_ensembles(members, integrator, interrupt_)) {
        out.push_back(std::move(result));
      }
    }
    return out;
  }

 private:
  const PointScenes& scenes_;
  const std::atomic<bool>& interrupt_;
};

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
  const Study& study = scenes.study();
  // Where each point says its integrator, any of them may be one with ensembles.
  const bool together = study.engine == EngineKind::kNative &&
                        (!study.integrator || has_ensemble(*study.integrator));
  return {scenes.sample().size(), together ? kEnsemblePoints : 1};
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

  const BatchRun batch(scenes, stop);
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
