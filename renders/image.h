// A picture in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rotorub::renders {

// 8-bit RGB, rows from the top of the picture down, no padding.
struct Image {
  int width = 0;                  // pixels
  int height = 0;                 // pixels
  std::vector<std::uint8_t> rgb;  // 3 * width * height

  // The first of the three bytes of a pixel; row 0 is the top one.
  const std::uint8_t* pixel(int column, int row) const {
    return rgb.data() + 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(column));
  }
};

}  // namespace rotorub::renders
