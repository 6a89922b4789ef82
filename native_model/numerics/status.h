// Outcome of a computation.
#pragma once

namespace rotorub {

// kNoSolution, kAmbiguous: the contact laws have no solution or several (Painleve). kOutOfRange:
// rotor or ring has left the range of its support. kControllerFailed: the user's law reported a
// failure, threw an exception or returned a value that is not finite.
enum class Status {
  kOk,
  kDiverged,
  kNoSolution,
  kAmbiguous,
  kStepTooLarge,
  kOutOfRange,
  kInterrupted,
  kControllerFailed
};

// The status of a problem with this number of solutions.
inline Status status_of(int solutions) {
  return solutions == 1 ? Status::kOk : solutions == 0 ? Status::kNoSolution : Status::kAmbiguous;
}

}  // namespace rotorub
