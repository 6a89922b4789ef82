// Other values of a key, derived from its row of the schema alone.
#pragma once

#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/scene/schema.h"
#include "native_model/scene/toml_source.h"

namespace rotorub::test {

// A value of this unit that affects the machines of pair_parts.h.
inline double typical(std::string_view unit) {
  static const std::map<std::string_view, double> values{
      {"1", 0.3},          {"rad", 0.5},   {"s", 1e-3},      {"m", 1e-4},       {"kg", 0.5},
      {"rad/s", 350.0},    {"1/s", 500.0}, {"1/s^2", 1e6},   {"m/s", 0.05},     {"rad/s^2", 4000.0},
      {"m/s^2", 5.0},      {"N", 30.0},    {"N m", 2.0},     {"kg m", 1e-3},    {"N/m", 1e4},
      {"N s/m", 50.0},     {"A", 0.5},     {"kg m^2", 1e-3}, {"N m/rad", 20.0}, {"N m s/rad", 0.05},
      {"A/s", 300.0},      {"N/A", 60.0},  {"A/m", 2500.0},  {"A/(m s)", 1e5},  {"A s/m", 3.0},
      {"V", 0.5},          {"Ohm", 2.0},   {"H", 5e-3},      {"Pa", 1e11},      {"kg/m^3", 5000.0},
      {"N m^2/A^2", 3e-4}, {"s/m", 5e-3}};
  const auto found = values.find(unit);
  return found == values.end() ? 1.0 : found->second;
}

inline double number_of(const scene::TomlNode& node) {
  return node.kind == scene::TomlNode::Kind::kInteger ? static_cast<double>(node.integer)
                                                      : node.number;
}

inline std::string list_text(const std::vector<double>& numbers, double factor) {
  std::string text;
  for (const double number : numbers)
    text += (text.empty() ? "[" : ", ") + fmt::format("{}", number * factor);
  return text + "]";
}

// Values as an override writes them; some will not fit the rest of a scene. given: the value in the
// scene; null if there is none.
inline std::vector<std::string> other_values(const scene::Key& key, const scene::TomlNode* given) {
  using scene::ValueType;
  std::vector<std::string> values;
  const double usual = typical(key.quantity.unit);
  switch (key.type) {
    case ValueType::kNumber:
    case ValueType::kPlanes:
      if (given != nullptr && given->items.empty()) {
        values = {fmt::format("{}", 1.25 * number_of(*given)),
                  fmt::format("{}", 0.8 * number_of(*given))};
      }
      for (const double factor : {1.0, 10.0, 0.1, -1.0, 100.0})
        values.push_back(fmt::format("{}", factor * usual));
      break;
    case ValueType::kVector:
    case ValueType::kList:
      if (given != nullptr && !given->items.empty()) {
        std::vector<double> numbers;
        for (const scene::TomlNode& item : given->items) numbers.push_back(number_of(item));
        values = {list_text(numbers, 1.25), list_text(numbers, 0.8)};
      }
      // Lists with as many values as there are modes, planes or points; one of them fits.
      for (const double factor : {usual, 0.1 * usual}) {
        for (const std::vector<double>& numbers :
             std::vector<std::vector<double>>{{1.0}, {1.0, -0.6}, {1.0, 0.6}, {1.0, 0.6, 1.7}})
          values.push_back(list_text(numbers, factor));
      }
      break;
    case ValueType::kWhole:
      if (given != nullptr && given->kind == scene::TomlNode::Kind::kInteger) {
        values = {fmt::format("{}", given->integer + 1), fmt::format("{}", given->integer - 1)};
      }
      values.insert(values.end(), {"2", "3"});
      break;
    case ValueType::kWord:
      for (const std::string_view word : key.words) values.push_back(fmt::format("'{}'", word));
      break;
    case ValueType::kFlag:
      values = {"true", "false"};
      break;
    case ValueType::kText:
      values = {"'G 30'"};
      break;
  }
  return values;
}

}  // namespace rotorub::test
