// The units in which a terminal shows a result.
#pragma once

#include <string>
#include <string_view>

namespace rotorub::result {

// As the results are written (mm, µm, N); SI alone; mm and N; mil and lbf.
enum class Units { kAsWritten, kSi, kMm, kUs };
// "si", "mm" or "us"; kAsWritten for other words.
Units units_of(std::string_view word);

// The text with each number and its unit, "3.5 µm", in the chosen units.
std::string in_units(std::string_view text, Units units);

// The end of a label or heading, "least gap, µm", that is a unit, and what replaces it.
struct UnitChange {
  std::string_view from, to;
  double factor = 1.0;  // of the values
};
// Null if the label does not end with a unit that changes.
const UnitChange* unit_change(std::string_view label, Units units);
// A number by itself, times the factor; other text unchanged.
std::string times(const std::string& text, double factor);

}  // namespace rotorub::result
