// Where things stand in a picture.
#pragma once

#include <vector>

#include "renders/framing.h"
#include "renders/sheet.h"

namespace rotorub::renders {

// One run. Areas that a view has not are empty.
struct PanelLayout {
  Area machine;  // MuJoCo's picture; of all panels equally large
  Area section, unrolled;
  Area caption;  // where the run is named
  std::vector<Area> charts;
};

struct Layout {
  int text_size = 17;  // pixels
  Area header;
  std::vector<PanelLayout> panels;  // side by side, from the left
};

// `contact`: without one there is the machine alone, in the views that show it.
Layout make_layout(int width, int height, FilmView view, int panels, int charts, bool contact);

}  // namespace rotorub::renders
