// Adapts test documents, which are written for MuJoCo 2.2, to the MuJoCo under test.
#pragma once

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <string>

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

// Replaces the first `from` by `to`.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace rotorub::test
