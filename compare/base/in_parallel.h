// Runs independent work on several processors.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace rotorub {

// Number of threads; 0: one per processor.
using Jobs = int;

// Calls work(0), ..., work(count - 1) once each, started in this order. After an exception or an
// interrupt, calls that have not started are skipped; the first exception in this order is
// rethrown. progress (fraction done; may be empty) is called by one thread at a time.
void in_parallel(std::size_t count, Jobs jobs, const std::atomic<bool>* interrupt,
                 const std::function<void(double)>& progress,
                 const std::function<void(std::size_t)>& work);

}  // namespace rotorub
