// SIGINT as a flag that long work polls.
#pragma once

#include <atomic>

namespace rotorub {

// From now on the first SIGINT sets the flag, the second one ends the program.
void catch_interrupts();
const std::atomic<bool>& interrupted();

}  // namespace rotorub
