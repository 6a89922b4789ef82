// The shaft of relevitation.toml on its two magnetic bearings, which work all the time.
#pragma once

#include <string>

#include "tests/support/native_run.h"

namespace rotorub::test {

// delay: of both controls, from sample to current.
inline scene::Scene levitated_rotor(const std::string& delay = "0") {
  std::vector<std::string> changes{"rotor.modes=3", "rotor.speed=3000 rpm"};
  for (const char* bearing : {"magnetic_bearing[0]", "magnetic_bearing[1]"}) {
    const std::string control = std::string(bearing) + ".control.";
    changes.push_back(control + "on=0");
    changes.push_back(control + "fails_at=none");
    changes.push_back(control + "returns_at=none");
    changes.push_back(control + "delay=" + delay);
  }
  return shipped("relevitation", changes);
}

}  // namespace rotorub::test
