#include "compare/sweep/sweep_run.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <iterator>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "compare/engine/mujoco_engine.h"
#include "compare/sweep/point_run.h"

namespace rotorub::sweep {
namespace {

using namespace std::chrono_literals;
constexpr auto kStoreEvery = 100ms;         // a transaction waits for the disk
constexpr std::size_t kMostWaiting = 4096;  // results that wait for the store

using Results = std::vector<PointResult>;

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

// Threads that run points, and what they hand to the one that stores; joined, whatever happens.
class Workers {
 public:
  // Each thread calls `work` until it gives nothing or `stop` is set, which a failure sets too.
  Workers(int count, std::function<std::optional<Results>()> work, std::atomic<bool>& stop)
      : work_(std::move(work)), stop_(stop), running_(count) {
    for (int k = 0; k < count; ++k) threads_.emplace_back([this] { run(); });
  }
  ~Workers() {
    stop_ = true;
    const std::lock_guard<std::mutex> lock(mutex_);
    room_.notify_all();
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  // What has come, after `patience` or when the last thread has ended.
  Results take(std::chrono::milliseconds patience, bool& ended) {
    std::unique_lock<std::mutex> lock(mutex_);
    news_.wait_for(lock, patience,
                   [&] { return running_ == 0 || waiting_.size() >= kMostWaiting; });
    ended = running_ == 0;
    room_.notify_all();
    return std::exchange(waiting_, {});
  }
  // The first failure, once all have ended.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void run() {
    std::exception_ptr failure;
    try {
      while (!stop_) {
        std::optional<Results> results = work_();
        if (!results) break;
        put(std::move(*results));
      }
    } catch (...) {
      failure = std::current_exception();
      stop_ = true;
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    --running_;
    if (failure && !failure_) failure_ = failure;
    news_.notify_one();
  }
  void put(Results results) {
    std::unique_lock<std::mutex> lock(mutex_);
    room_.wait(lock, [&] { return waiting_.size() < kMostWaiting || stop_; });
    std::move(results.begin(), results.end(), std::back_inserter(waiting_));
    news_.notify_one();
  }

  std::function<std::optional<Results>()> work_;
  std::atomic<bool>& stop_;
  std::mutex mutex_;
  std::condition_variable room_, news_;
  Results waiting_;
  std::exception_ptr failure_;
  int running_;
  std::vector<std::jthread> threads_;  // the last member: joined before the others go
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
  std::atomic<bool> stop{false};
  std::optional<MujocoInPlace> mujoco;
  if (scenes.study().engine == EngineKind::kMujoco) mujoco.emplace();

  const auto scene_at = [&](std::int64_t point) { return scenes.at(point); };
  Workers workers(
      options.jobs,
      [&]() -> std::optional<Results> {
        const auto points = work.next();
        if (!points) return std::nullopt;
        return run_batch(scenes.study(), *points, scene_at, stop);
      },
      stop);
  for (bool ended = false; !ended;) {
    if (options.interrupt && *options.interrupt) stop = true;
    const Results results = workers.take(kStoreEvery, ended);
    if (!results.empty()) store.add(results, scenes.sample());
    stored += static_cast<std::int64_t>(results.size());
    now += static_cast<std::int64_t>(results.size());
    if (options.progress) options.progress(stored, of, now);
  }
  workers.rethrow();
  return stored == of;
}

}  // namespace rotorub::sweep
