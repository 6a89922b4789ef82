#include "compare/bench/ladder.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <sstream>
#include <stdexcept>

#include "native_model/scene/units.h"

namespace rotorub::bench {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// Entries in falling order, each once. `wrong`: why a value is not accepted; empty: it is.
std::vector<double> parse_list(const char* option, const std::string& list,
                               const scene::Quantity& quantity,
                               const std::function<std::string(double)>& wrong) {
  std::vector<double> values;
  std::istringstream entries(list + ",");  // an entry after the last comma is one too
  for (std::string entry; std::getline(entries, entry, ',');) {
    const std::string text = trimmed(entry);
    const auto parsed = scene::parse_quantity(text, quantity);
    const std::string why = parsed.error.empty() ? wrong(parsed.value) : parsed.error;
    if (!why.empty()) {
      throw std::invalid_argument(fmt::format("{} {}: `{}`: {}", option, list, text, why));
    }
    values.push_back(parsed.value);
  }
  if (values.empty()) throw std::invalid_argument(fmt::format("{}: the list is empty", option));
  std::sort(values.begin(), values.end(), std::greater<>());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace

Ladder default_ladder() {
  return {{2e-4, 1e-4, 5e-5, 2e-5, 1e-5, 5e-6, 2e-6, 1e-6},
          {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12}};
}

std::vector<double> parse_steps(const std::string& list) {
  return parse_list("--steps", list, scene::kTime, [](double step) -> std::string {
    return step > 0.0 ? "" : "accepted is a time above 0, as 10us";
  });
}

std::vector<double> parse_tolerances(const std::string& list) {
  return parse_list("--tolerances", list, scene::kPure, [](double tolerance) -> std::string {
    return tolerance > 0.0 && tolerance < 1.0 ? "" : "accepted is a number in (0, 1), as 1e-8";
  });
}

}  // namespace rotorub::bench
