// SIGINT, SIGTERM and SIGHUP as a flag that long work polls.
#pragma once

#include <atomic>

namespace rotorub {

// From now on the first of them sets the flag, the second of its kind ends the program, as 20 s do
// after a SIGTERM or SIGHUP. One that the program was started to ignore stays ignored.
void catch_interrupts();
const std::atomic<bool>& interrupted();
int interrupting_signal();  // 0: none yet

}  // namespace rotorub
