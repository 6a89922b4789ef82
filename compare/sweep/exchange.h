// Threads that run points, and what they hand to the one that stores.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <iterator>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "compare/sweep/point_result.h"

namespace rotorub::sweep {

inline constexpr std::size_t kMostWaiting = 4096;  // results that wait for the store

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
  std::vector<PointResult> take(std::chrono::milliseconds patience, bool& ended) {
    std::unique_lock<std::mutex> lock(mutex_);
    news_.wait_for(lock, patience,
                   [&] { return workers_ == 0 || waiting_.size() >= kMostWaiting; });
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

// The threads; joined, whatever happens.
class Workers {
 public:
  Workers(int count, const std::function<void()>& work, Exchange& exchange, std::atomic<bool>& stop)
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

}  // namespace rotorub::sweep
