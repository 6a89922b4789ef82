// Marks a thread that takes steps in order to linearise them (plugin/differences.h).
#pragma once

namespace rotorub::plugin {

class Differentiating {  // in_this_thread() is true while one lives in the thread
 public:
  Differentiating() { running_ = true; }
  ~Differentiating() { running_ = false; }
  Differentiating(const Differentiating&) = delete;
  Differentiating& operator=(const Differentiating&) = delete;

  static bool in_this_thread() { return running_; }

 private:
  static inline thread_local constinit bool running_ = false;
};

}  // namespace rotorub::plugin
