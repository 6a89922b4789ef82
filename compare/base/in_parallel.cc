#include "compare/base/in_parallel.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace rotorub {

void in_parallel(std::size_t count, Jobs jobs, const std::atomic<bool>* interrupt,
                 const std::function<void(double)>& progress,
                 const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::size_t done = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  std::size_t failed = count;
  const auto stopped = [&] { return interrupt && interrupt->load(); };
  const auto take = [&] {
    std::size_t k = count;
    try {
      for (k = next++; k < count && !stopped(); k = next++) {
        work(k);
        const std::lock_guard lock(mutex);
        ++done;
        if (progress) progress(static_cast<double>(done) / static_cast<double>(count));
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (k < failed) {
        failed = k;
        failure = std::current_exception();
      }
      next = count;
    }
  };
  const std::size_t threads =
      jobs > 0 ? static_cast<std::size_t>(jobs)
               : std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, 16);
  std::vector<std::thread> others;
  for (std::size_t k = 1; k < std::min(threads, count); ++k) others.emplace_back(take);
  take();
  for (std::thread& thread : others) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace rotorub
