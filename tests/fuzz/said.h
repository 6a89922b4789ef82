// Checks the text of a refusal and ends the program if it is not allowed, as a fuzzer expects it.
#pragma once

#include <cstdlib>
#include <sstream>
#include <string>

#include "native_model/scene/text.h"

namespace rotorub::test {

inline void check_said(const std::string& message) {
  constexpr std::size_t kLongest = 16u << 10u;
  if (message.empty() || message.size() > kLongest) std::abort();
  std::istringstream lines(message);
  for (std::string line; std::getline(lines, line);) {
    if (scene::printable(line, line.size()) != line) std::abort();
  }
}

}  // namespace rotorub::test
