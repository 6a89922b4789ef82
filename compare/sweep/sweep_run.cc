#include "compare/sweep/sweep_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <optional>
#include <utility>

#include "compare/base/in_parallel.h"
#include "compare/engine/mujoco_engine.h"
#include "compare/sweep/point_run.h"

namespace rotorub::sweep {
namespace {

using namespace std::chrono_literals;
constexpr auto kStoreEvery = 100ms;            // few transactions, because each waits for the disk
constexpr std::size_t kMostWaiting = 1 << 14;  // results waiting for the store

// Places of the first points, in sixteenths: any leading part of this list is spread evenly.
constexpr std::int64_t kPlaces = 16;
constexpr std::array<std::int64_t, kPlaces> kFirst{8, 4, 12, 2, 10, 6, 14, 1,
                                                   9, 5, 13, 3, 11, 7, 15, 0};

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

// Results of points and the computing time of the threads.
struct Results {
  std::vector<PointResult> points;
  double busy = 0.0;  // s, summed over the threads
};

// The results that wait for the storing thread.
class Waiting {
 public:
  // Waits while there are many, unless `stop` is set.
  void put(std::optional<PointResult> result, double busy, const std::atomic<bool>& stop) {
    std::unique_lock<std::mutex> lock(mutex_);
    while (results_.points.size() >= kMostWaiting && !stop) room_.wait_for(lock, kStoreEvery);
    if (result) results_.points.push_back(std::move(*result));
    results_.busy += busy;
  }
  Results take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    room_.notify_all();
    return std::exchange(results_, {});
  }

 private:
  std::mutex mutex_;
  std::condition_variable room_;
  Results results_;
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
  Waiting waiting;
  std::atomic<bool> stop{false};
  std::optional<MujocoInPlace> mujoco;
  if (scenes.study().engine == EngineKind::kMujoco) mujoco.emplace();

  const auto run = [&](std::size_t) {
    try {
      for (auto point = work.next(); point && !stop; point = work.next()) {
        const auto start = Clock::now();
        auto result = run_point(
            scenes.study(), *point, [&](std::int64_t k) { return scenes.at(k); }, stop);
        waiting.put(std::move(result), seconds_since(start), stop);
      }
    } catch (...) {
      stop = true;  // for the other threads
      throw;
    }
  };
  const auto jobs = static_cast<std::size_t>(options.jobs);
  auto running =
      std::async(std::launch::async, [&] { in_parallel(jobs, options.jobs, nullptr, {}, run); });
  double busy = 0.0;
  const auto store_results = [&] {
    const Results results = waiting.take();
    if (!results.points.empty()) store.add(results.points, scenes.sample());
    const auto count = static_cast<std::int64_t>(results.points.size());
    at.stored += count;
    at.now += count;
    busy += results.busy;
    at.left = time_left(at, busy, options.jobs);
    if (options.progress) options.progress(at);
  };
  try {
    for (bool ended = false; !ended;) {
      if (options.interrupt && *options.interrupt) stop = true;
      ended = running.wait_for(kStoreEvery) == std::future_status::ready;
      store_results();
    }
  } catch (...) {
    stop = true;  // the destructor of the future waits for the threads
    throw;
  }
  running.get();
  return at.stored == at.of;
}

}  // namespace rotorub::sweep
