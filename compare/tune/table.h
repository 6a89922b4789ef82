// The result of tune as text for the terminal.
#pragma once

#include <string>

#include "compare/base/palette.h"
#include "compare/tune/tune.h"

namespace rotorub::tune {

std::string tune_table(const TuneResult& result, const Palette& palette = Palette());

}  // namespace rotorub::tune
