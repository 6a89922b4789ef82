#include "compare/commands/ranges.h"

#include <fmt/format.h>

#include <charconv>

#include "compare/commands/command.h"

namespace rotorub {
namespace {

[[noreturn]] void refuse_range(const char* option, const std::string& text,
                               const std::string& why) {
  throw UsageError(fmt::format("{} {}: {}; accepted is FROM:TO:COUNT", option, text, why));
}

double value_of(const char* option, const std::string& all, const std::string& part,
                const scene::Quantity& quantity) {
  const auto parsed = scene::parse_quantity(part, quantity);
  if (!parsed.error.empty()) refuse_range(option, all, parsed.error);
  return parsed.value;
}

int count_of(const char* option, const std::string& all, const std::string& part) {
  int count = 0;
  const auto end = std::from_chars(part.data(), part.data() + part.size(), count);
  if (end.ec != std::errc() || end.ptr != part.data() + part.size() || count < 2 || count > 1000) {
    refuse_range(option, all, "COUNT is a whole number from 2 to 1000");
  }
  return count;
}

}  // namespace

std::vector<double> even_values(double from, double to, int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) {
    values.push_back(k + 1 == count ? to : from + (to - from) * k / (count - 1));
  }
  return values;
}

std::vector<double> range_values(const char* option, const std::string& text,
                                 const scene::Quantity& quantity) {
  const std::size_t first = text.find(':'), last = text.rfind(':');
  if (first == std::string::npos || first == last || text.find(':', first + 1) != last) {
    refuse_range(option, text, "it has three parts");
  }
  const double from = value_of(option, text, text.substr(0, first), quantity);
  const double to = value_of(option, text, text.substr(first + 1, last - first - 1), quantity);
  const int count = count_of(option, text, text.substr(last + 1));
  if (!(from >= 0.0) || !(to > from))
    refuse_range(option, text, "FROM is 0 or more and TO above it");
  return even_values(from, to, count);
}

}  // namespace rotorub
