// Values of an option as FROM:TO:COUNT.
#pragma once

#include <string>
#include <vector>

#include "native_model/scene/units.h"

namespace rotorub {

// The parts between colons.
std::vector<std::string> parts_of(const std::string& range);

// `count` >= 2 evenly spaced values, including both ends.
std::vector<double> even_values(double from, double to, int count);

// SI. 2 to 1,000 ascending values, >= 0. Throws UsageError, which names the option.
std::vector<double> range_values(const char* option, const std::string& text,
                                 const scene::Quantity& quantity);

}  // namespace rotorub
