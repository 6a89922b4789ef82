// Marks the mjData whose states are nudged in order to linearise a model (plugin/differences.h).
#pragma once

#include <mujoco/mujoco.h>

namespace rotorub::plugin {

// While it lives, the steps of these two mjData are differences. A step that fails may leave by
// longjmp, which skips the destructor. Nobody deletes the two mjData then, so the mark can never
// stand for another one.
class Differentiating {
 public:
  Differentiating(const mjData* low, const mjData* high) { low_ = low, high_ = high; }
  ~Differentiating() { low_ = high_ = nullptr; }
  Differentiating(const Differentiating&) = delete;
  Differentiating& operator=(const Differentiating&) = delete;

  static bool nudges(const mjData* d) { return d == low_ || d == high_; }

 private:
  static inline thread_local constinit const mjData *low_ = nullptr, *high_ = nullptr;
};

}  // namespace rotorub::plugin
