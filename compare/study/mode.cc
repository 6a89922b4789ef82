#include "compare/study/mode.h"

#include <cassert>

namespace rotorub {

const char* to_string(CompareMode mode) {
  switch (mode) {
    case CompareMode::kLockstep:
      return "lockstep";
    case CompareMode::kReplay:
      return "replay";
    case CompareMode::kResync:
      return "resync";
  }
  return "";
}

CompareMode compare_mode_of(const std::string& name) {
  for (const CompareMode mode : {CompareMode::kReplay, CompareMode::kResync}) {
    if (name == to_string(mode)) return mode;
  }
  assert(name == to_string(CompareMode::kLockstep));
  return CompareMode::kLockstep;
}

}  // namespace rotorub
