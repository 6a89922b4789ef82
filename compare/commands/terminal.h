// What a stream is written to.
#pragma once

#include <cstdio>

#include "compare/base/palette.h"

namespace rotorub {

bool is_terminal(std::FILE* stream);
// Colours on a terminal that has them, unless NO_COLOR is set to something (no-color.org).
Palette palette_of(std::FILE* stream);
// Of a terminal; 80 where nothing else is known.
int columns_of(std::FILE* stream);

}  // namespace rotorub
