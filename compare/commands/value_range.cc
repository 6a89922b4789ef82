#include "compare/commands/value_range.h"

#include <boost/algorithm/string/split.hpp>
#include <charconv>

#include "compare/commands/command.h"

namespace rotorub {
namespace {

[[noreturn]] void refuse_range(const char* option, const std::string& text,
                               const std::string& why) {
  throw UsageError("{} {}: {}; expected FROM:TO:COUNT", option, text, why);
}

}  // namespace

std::vector<std::string> parts_of(const std::string& range) {
  std::vector<std::string> parts;
  boost::split(parts, range, [](char c) { return c == ':'; });
  return parts;
}

std::vector<double> even_values(double from, double to, int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) {
    values.push_back(k + 1 == count ? to : from + (to - from) * k / (count - 1));
  }
  return values;
}

std::vector<double> range_values(const char* option, const std::string& text,
                                 const scene::Quantity& quantity) {
  const std::vector<std::string> parts = parts_of(text);
  if (parts.size() != 3) refuse_range(option, text, "it needs three parts");
  const double from = quantity_of(option, parts[0], quantity);
  const double to = quantity_of(option, parts[1], quantity);
  const char* const end = parts[2].data() + parts[2].size();
  int count = 0;
  const auto read = std::from_chars(parts[2].data(), end, count);
  if (read.ec != std::errc() || read.ptr != end || count < 2 || count > 1000)
    refuse_range(option, text, "COUNT must be a whole number from 2 to 1000");
  if (!(from >= 0.0) || !(to > from))
    refuse_range(option, text, "FROM must be 0 or more, and TO above FROM");
  return even_values(from, to, count);
}

}  // namespace rotorub
