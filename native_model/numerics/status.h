// How a computation ended.
#pragma once

namespace rotorub {

// kNoSolution, kAmbiguous: the contact laws have none or several (Painleve). kOutOfRange: rotor or
// ring beyond what holds it. kControllerFailed: the user's law reported a failure, threw, or
// returned what is no number.
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

// Of a problem that has so many solutions.
inline Status status_of(int solutions) {
  return solutions == 1 ? Status::kOk : solutions == 0 ? Status::kNoSolution : Status::kAmbiguous;
}

}  // namespace rotorub
