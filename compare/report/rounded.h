#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace rotorub {

// A plot shows no more than 6 or 7 significant digits, and the page stays small.
inline constexpr int kDigits = 6;

// The value to so many significant digits.
double rounded(double value, int digits);
// Those of the values, each rounded.
nlohmann::json picked(const std::vector<double>& values, const std::vector<std::size_t>& which,
                      int digits);

}  // namespace rotorub
