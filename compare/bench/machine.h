// What times were measured on.
#pragma once

#include <string>

namespace rotorub::bench {

struct Machine {
  std::string processor;     // as the kernel names it
  int threads = 0;           // hardware threads; every run here takes one
  std::string instructions;  // the widest vector instructions of the processor
  std::string compiler;
  std::string mujoco;  // version
};
Machine this_machine();

}  // namespace rotorub::bench
