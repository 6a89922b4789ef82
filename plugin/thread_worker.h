// What a thread steps models with: room, and nothing that outlives a call, so that several threads
// may step several mjData of one model. A worker has a model of its own, as the Config may be gone
// before the thread is.
#pragma once

#include <memory>
#include <utility>

#include "plugin/config.h"
#include "plugin/in_turns.h"

namespace rotorub::plugin {

// This thread's Worker for the model and the step h (s), made where it is new or was long not used.
// Worker(const Config&, double h).
template <class Worker>
Worker& thread_worker(const Config& config, double h) {
  thread_local InTurns<std::pair<double, double>, std::unique_ptr<Worker>> known;
  const std::pair key{config.id, h};
  if (const auto* worker = known.find(key)) return **worker;
  return *known.add(key, std::make_unique<Worker>(config, h));
}

}  // namespace rotorub::plugin
