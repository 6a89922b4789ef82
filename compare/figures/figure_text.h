// Values and differences of figures as people read them, the same on the terminal and in the page.
#pragma once

#include <string>

#include "compare/figures/figure.h"

namespace rotorub {

// A value of a figure, in the unit that the figure is written in.
std::string figure_value(const Figure& figure, double value);
// "+0.52 %", "-77 pts", "×188" on the figure's scale; "∞" where the native value is 0; "–" for a
// figure that is not comparable.
std::string deviation_text(const Figure& figure, double deviation);
// The same of a size: without a plus.
std::string size_text(const Figure& figure, double size);

}  // namespace rotorub
