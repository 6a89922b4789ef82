// Whether this thread takes steps to linearise them (plugin/differences.h).
#pragma once

namespace rotorub::plugin {

class Differentiating {  // they are taken while one lives in this thread
 public:
  Differentiating();
  ~Differentiating();
  Differentiating(const Differentiating&) = delete;
  Differentiating& operator=(const Differentiating&) = delete;

  static bool in_this_thread();
};

}  // namespace rotorub::plugin
