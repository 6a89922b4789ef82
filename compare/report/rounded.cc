#include "compare/report/rounded.h"

#include <charconv>
#include <nlohmann/json.hpp>

namespace rotorub {

double rounded(double value, int digits) {
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
  double short_value = value;
  std::from_chars(text, end.ptr, short_value);
  return short_value;
}

nlohmann::json picked(const std::vector<double>& values, const std::vector<std::size_t>& which,
                      int digits) {
  nlohmann::json out = nlohmann::json::array();
  for (const std::size_t i : which) out.push_back(rounded(values[i], digits));
  return out;
}

}  // namespace rotorub
