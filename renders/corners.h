// Places for texts beside the disc in the middle of a picture.
#pragma once

#include <array>
#include <vector>

#include "renders/sheet.h"

namespace rotorub::renders {

// Boxes in the corners of a picture: each in the first corner (upper left, upper right, lower left)
// where it covers neither the disc in the middle nor an earlier box. A box that has no such place
// is in the upper left corner, below the earlier ones there. All in pixels.
class Corners {
 public:
  // reach: the disc's radius. top: where the upper boxes may begin. bottom: the height that is
  // taken at the lower left; if it is negative, no box is there.
  Corners(const Area& area, double reach, double top, double bottom)
      : width_(area.width), height_(area.height), reach_(reach), used_{top, top, bottom} {}

  // The upper left corner of the next box.
  Sheet::Point next(double wide, double high);

 private:
  struct Box {
    Sheet::Point at, size;
  };
  Sheet::Point place(std::size_t corner, double wide, double high) const;
  bool is_free(const Box& box) const;

  double width_, height_, reach_;
  std::array<double, 3> used_;  // height at each corner
  std::vector<Box> taken_;
};

}  // namespace rotorub::renders
