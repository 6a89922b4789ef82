// Numbers for people, in the same format on the terminal and in pages.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "compare/base/units.h"

namespace rotorub {

// Four significant digits, no exponent between 1e-3 and 1e6: "21.86", "0.0112", "1.2e-07", "0".
std::string short_number(double value);
// A share as a percentage: "1 %".
std::string percent_text(double share);
// A time with a fitting unit: "10 µs", "0.5 s".
std::string time_text(double seconds);

// A scene's key in words: "contact friction", "rotor disc 2 eccentricity".
std::string key_in_words(std::string_view key);
// The unit in which people read a value in SI of this size: mm for a clearance, kN/m for a spring.
ShownUnit usual_unit(double value, std::string_view unit);
// The value in this unit: "0.4 mm".
std::string usual_text(double value, std::string_view unit);

inline constexpr std::size_t kTerminalWidth = 80;
// Wraps a sentence into lines of at most kTerminalWidth. The first line begins with `lead`; the
// others are indented, by default to its width.
std::string wrapped(const std::string& lead, const std::string& sentence,
                    std::optional<std::size_t> indent = {});

}  // namespace rotorub
