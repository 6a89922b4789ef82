// Adapts test documents, which are written for MuJoCo 2.2, to the MuJoCo under test.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "tests/support/said.h"

namespace rotorub::test {

// MuJoCo 3.0 removed <option collision="predefined">; instead all geoms get contype 0.
inline std::string for_this_mujoco(std::string document) {
  for (const std::string option : {"collision='predefined'", "collision=\"predefined\""}) {
    const std::size_t at = document.find(option);
    if (mjVERSION_HEADER < 300 || at == std::string::npos) continue;
    document.erase(at, option.size());
    document.insert(document.find("<worldbody>"),
                    "<default><geom contype='0' conaffinity='0'/></default>");
  }
  return document;
}

}  // namespace rotorub::test
