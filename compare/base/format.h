// Numbers as people read them, the same on the terminal and in the page.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace rotorub {

// Four significant digits, no exponent between 1e-3 and 1e6: "21.86", "0.0112", "1.2e-07", "0".
std::string short_number(double value);
// A share as a percentage: "1 %".
std::string percent_text(double share);
// A time with a fitting unit: "10 µs", "0.5 s".
std::string time_text(double seconds);

// The name of a run's contact model over its column of a terminal's table; empty: no column, as for
// MuJoCo's defaults, which have their row in the answer and their column in the report.
std::string column_heading(const std::string& label);

inline constexpr std::size_t kTerminalWidth = 80;
// The words of a sentence in lines of at most kTerminalWidth, the first after `lead`, the others
// indented: by default below it.
std::string wrapped(const std::string& lead, const std::string& sentence,
                    std::optional<std::size_t> indent = {});

}  // namespace rotorub
