// Positions of the parts of a picture.
#pragma once

#include <vector>

#include "renders/framing.h"
#include "renders/sheet.h"

namespace rotorub::renders {

// The areas of one run. Areas that a view does not use are empty.
struct PanelLayout {
  Area machine;  // MuJoCo's picture; the same size in all panels
  Area section, unrolled;
  Area caption;  // name of the run
  std::vector<Area> charts;
};

struct Layout {
  int text_size = 17;  // pixels
  Area header;
  std::vector<PanelLayout> panels;  // side by side, from the left
};

// Without `contact`, the views that show the machine show only the machine.
Layout make_layout(int width, int height, FilmView view, int panels, int charts, bool contact);

}  // namespace rotorub::renders
