#include "compare/report/rounded.h"

#include <charconv>

namespace rotorub {

double rounded(double value, int digits) {
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
  double short_value = value;
  std::from_chars(text, end.ptr, short_value);
  return short_value;
}

}  // namespace rotorub
