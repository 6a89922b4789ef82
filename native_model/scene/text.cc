#include "native_model/scene/text.h"

#include <array>
#include <cstdio>

namespace rotorub::scene {

std::string number_text(double number, int digits) {
  std::array<char, 40> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, number);
  return buffer.data();
}

std::string list_element(const std::string& list, std::size_t index) {
  return list + "[" + std::to_string(index) + "]";
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace rotorub::scene
