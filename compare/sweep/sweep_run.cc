#include "compare/sweep/sweep_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <deque>
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
constexpr auto kStoreEvery = 100ms;         // few transactions, because each waits for the disk
constexpr std::size_t kMostWaiting = 4096;  // results waiting for the store

// Places of the first points, in sixteenths: any leading part of this list is spread evenly.
constexpr std::int64_t kPlaces = 16;
constexpr std::array<std::int64_t, kPlaces> kFirst{8, 4, 12, 2, 10, 6, 14, 1,
                                                   9, 5, 13, 3, 11, 7, 15, 0};

// Results of points and the computing time of the threads.
struct Results {
  std::vector<PointResult> points;
  double busy = 0.0;  // s, summed over the threads
};

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Hands out the points of the shard: first some that are spread over it, then the others in order.
class Work {
 public:
  Work(std::int64_t points, const Shard& shard, std::vector<bool> done)
      : points_(points), shard_(shard), done_(std::move(done)), next_(shard.number - 1) {
    const std::int64_t own = shard.points_of(points);
    for (const std::int64_t place : kFirst) {
      if (own > 0) take(next_ + own * place / kPlaces * shard.count);
    }
  }

  // The next point without a result; empty if there is none.
  std::optional<std::int64_t> next() {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (; first_.empty() && next_ < points_; next_ += shard_.count) take(next_);
    if (first_.empty()) return std::nullopt;
    const std::int64_t point = first_.front();
    first_.pop_front();
    return point;
  }

 private:
  // Appends the point to `first_` unless it is done.
  void take(std::int64_t point) {
    if (done_[static_cast<std::size_t>(point)]) return;
    done_[static_cast<std::size_t>(point)] = true;
    first_.push_back(point);
  }

  std::mutex mutex_;
  std::int64_t points_;
  Shard shard_;
  std::vector<bool> done_;  // stored or handed out
  std::deque<std::int64_t> first_;
  std::int64_t next_;
};

// Threads that run points and collect their results for the storing thread. The destructor joins
// them.
class Workers {
 public:
  // Each thread calls `work` until it returns nothing or `stop` is set; an exception sets it too.
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

  // The collected results, after at most `patience` or when the last thread has ended.
  Results take(std::chrono::milliseconds patience, bool& ended) {
    std::unique_lock<std::mutex> lock(mutex_);
    news_.wait_for(lock, patience,
                   [&] { return running_ == 0 || waiting_.points.size() >= kMostWaiting; });
    ended = running_ == 0;
    room_.notify_all();
    return std::exchange(waiting_, {});
  }
  // Rethrows the first exception; call it after all threads have ended.
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
    room_.wait(lock, [&] { return waiting_.points.size() < kMostWaiting || stop_; });
    std::move(results.points.begin(), results.points.end(), std::back_inserter(waiting_.points));
    waiting_.busy += results.busy;
    news_.notify_one();
  }

  std::function<std::optional<Results>()> work_;
  std::atomic<bool>& stop_;
  std::mutex mutex_;
  std::condition_variable room_, news_;
  Results waiting_;
  std::exception_ptr failure_;
  int running_;
  // Last member, so that it is joined before the others are destroyed.
  std::vector<std::jthread> threads_;
};

// s, from the average time per point so far.
std::optional<double> time_left(const SweepProgress& at, double busy, int jobs) {
  const std::int64_t left = at.of - at.stored;
  if (left == 0) return 0.0;
  if (at.now == 0) return std::nullopt;
  const auto threads = static_cast<double>(std::min<std::int64_t>(jobs, left));
  return busy / static_cast<double>(at.now) * static_cast<double>(left) / threads;
}

}  // namespace

bool run_sweep(const PointScenes& scenes, Store& store, const SweepOptions& options) {
  const std::int64_t points = scenes.sample().size();
  std::vector<bool> done = store.done();
  SweepProgress at;
  at.of = options.shard.points_of(points);
  at.stored = std::count(done.begin(), done.end(), true);
  Work work(points, options.shard, std::move(done));
  std::atomic<bool> stop{false};
  std::optional<MujocoInPlace> mujoco;
  if (scenes.study().engine == EngineKind::kMujoco) mujoco.emplace();

  const auto scene_at = [&](std::int64_t point) { return scenes.at(point); };
  Workers workers(
      options.jobs,
      [&]() -> std::optional<Results> {
        const auto point = work.next();
        if (!point) return std::nullopt;
        const auto start = Clock::now();
        Results results;
        if (auto result = run_point(scenes.study(), *point, scene_at, stop)) {
          results.points.push_back(std::move(*result));
        }
        results.busy = seconds_since(start);
        return results;
      },
      stop);
  double busy = 0.0;
  for (bool ended = false; !ended;) {
    if (options.interrupt && *options.interrupt) stop = true;
    const Results results = workers.take(kStoreEvery, ended);
    if (!results.points.empty()) store.add(results.points, scenes.sample());
    const auto count = static_cast<std::int64_t>(results.points.size());
    at.stored += count;
    at.now += count;
    busy += results.busy;
    at.left = time_left(at, busy, options.jobs);
    if (options.progress) options.progress(at);
  }
  workers.rethrow();
  return at.stored == at.of;
}

}  // namespace rotorub::sweep
