// What a thread steps models with: room, and nothing that outlives a call, so that several threads may
// step several mjData of one model. A worker has a model of its own, as the Config may be gone before
// the thread is.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "plugin/config.h"

namespace rotorub::plugin {

// This thread's Worker for the model and the step h (s), made where it is none of those used last.
// Worker(const Config&, double h) has members id and step.
template <class Worker>
Worker& thread_worker(const Config& config, double h) {
  thread_local std::array<std::unique_ptr<Worker>, 4> known;
  thread_local std::size_t next = 0;
  for (const auto& worker : known) {
    if (worker && worker->id == config.id && worker->step == h) return *worker;
  }
  std::unique_ptr<Worker>& made = known[next];
  next = (next + 1) % known.size();
  made = std::make_unique<Worker>(config, h);
  return *made;
}

}  // namespace rotorub::plugin
