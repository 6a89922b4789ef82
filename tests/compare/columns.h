// How wide a text is on a terminal.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

namespace rotorub::test {

// Characters of the longest line; bytes that continue a character do not count.
inline std::size_t widest_line(const std::string& text) {
  std::size_t widest = 0, column = 0;
  for (const char c : text) {
    if (c == '\n') {
      column = 0;
    } else if ((static_cast<unsigned char>(c) & 0xc0U) != 0x80U) {
      widest = std::max(widest, ++column);
    }
  }
  return widest;
}

}  // namespace rotorub::test
