// Independent work on several processors.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace rotorub {

// How many threads work: 0 stands for one a processor.
using Jobs = int;

// work(0), ..., work(count - 1), each once, in this order of starting. An exception ends what has
// not begun, and the first in this order is thrown on; an interrupt ends it too. `progress` (share
// done; may be empty) is called from one thread at a time.
void in_parallel(std::size_t count, Jobs jobs, const std::atomic<bool>* interrupt,
                 const std::function<void(double)>& progress,
                 const std::function<void(std::size_t)>& work);

}  // namespace rotorub
