#include "compare/sweep/sweep_run.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "compare/engine/mujoco_messages.h"
#include "compare/sweep/ensemble_points.h"
#include "compare/sweep/single_point.h"
#include "plugin/hooks.h"

namespace rotorub::sweep {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::int64_t kEnsemblePoints = 32;  // of a batch: whole groups on every instruction set
constexpr std::size_t kMostWaiting = 4096;    // results that wait for the store
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

// Between the threads that run and the one that stores.
class Exchange {
 public:
  void put(std::vector<PointResult> results) {
    std::unique_lock<std::mutex> lock(mutex_);
    room_.wait(lock, [&] { return waiting_.size() < kMostWaiting || stopped_; });
    std::move(results.begin(), results.end(), std::back_inserter(waiting_));
    news_.notify_one();
  }
  // What has come, after `patience` or when the last worker has left.
  std::vector<PointResult> take(Clock::duration patience, bool& ended) {
    std::unique_lock<std::mutex> lock(mutex_);
    news_.wait_for(lock, patience, [&] { return workers_ == 0 || waiting_.size() >= kMostWaiting; });
    ended = workers_ == 0;
    room_.notify_all();
    return std::exchange(waiting_, {});
  }
  void enter() {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++workers_;
  }
  void leave(std::exception_ptr failure) {
    const std::lock_guard<std::mutex> lock(mutex_);
    --workers_;
    if (failure && !failure_) failure_ = failure;
    news_.notify_one();
  }
  void stop() {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
    room_.notify_all();
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::mutex mutex_;
  std::condition_variable room_, news_;
  std::vector<PointResult> waiting_;
  std::exception_ptr failure_;
  int workers_ = 0;
  bool stopped_ = false;
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

// The threads; joined, whatever happens.
class Workers {
 public:
  Workers(int count, const std::function<void()>& work, Exchange& exchange,
          std::atomic<bool>& stop)
      : exchange_(exchange), stop_(stop) {
    for (int k = 0; k < count; ++k) {
      exchange.enter();
      threads_.emplace_back([&exchange, &stop, work] {
        std::exception_ptr failure;
        try {
          work();
        } catch (...) {
          failure = std::current_exception();
          stop = true;
        }
        exchange.leave(failure);
      });
    }
  }
  ~Workers() {
    stop_ = true;
    exchange_.stop();
    for (std::thread& thread : threads_) thread.join();
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

 private:
  Exchange& exchange_;
  std::atomic<bool>& stop_;
  std::vector<std::thread> threads_;
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
