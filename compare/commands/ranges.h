// Values of an option as FROM:TO:COUNT, e.g. 10Hz:100Hz:40.
#pragma once

#include <string>
#include <vector>

#include "native_model/scene/units.h"

namespace rotorub {

// count values, count >= 2, both ends among them.
std::vector<double> even_values(double from, double to, int count);

// SI. From 0 on, ascending, 2 to 1,000 values; else UsageError, which names the option.
std::vector<double> range_values(const char* option, const std::string& text,
                                 const scene::Quantity& quantity);

}  // namespace rotorub
