#include "compare/optimise/figure_path.h"

#include <algorithm>
#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

namespace rotorub::optimise {
namespace {

using nlohmann::json;

const json* element_of(const json& list, const std::string& part) {
  std::size_t k = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), k);
  const bool whole = error == std::errc() && end == part.data() + part.size();
  return whole && k < list.size() ? &list[k] : nullptr;
}

// Appends the numbers at the path to `numbers`. Returns false if some branch does not end at a
// number.
bool gather(const json& at, std::span<const std::string> parts, std::vector<double>& numbers) {
  if (parts.empty()) {
    if (!at.is_number() || !std::isfinite(at.get<double>())) return false;
    numbers.push_back(at.get<double>());
    return true;
  }
  const std::string& part = parts.front();
  if (at.is_array() && part == "*") {
    return std::all_of(at.begin(), at.end(),
                       [&](const json& item) { return gather(item, parts.subspan(1), numbers); });
  }
  const json* next = at.is_array()                         ? element_of(at, part)
                     : at.is_object() && at.contains(part) ? &at.at(part)
                                                           : nullptr;
  return next != nullptr && gather(*next, parts.subspan(1), numbers);
}

}  // namespace

FigurePath parse_figure(const std::string& text) {
  FigurePath path;
  path.text = text;
  boost::split(path.parts, text, boost::is_any_of("."));
  if (path.parts.front() == "modes") {
    path.source = Source::kModes;
    path.parts.erase(path.parts.begin());
  }
  const bool empty =
      path.parts.empty() || std::any_of(path.parts.begin(), path.parts.end(),
                                        [](const std::string& part) { return part.empty(); });
  if (empty) {
    throw std::invalid_argument(
        "expected a figure of the run, as \"peak_force\" or \"settled.spin_speed\", or of what "
        "`rotorub modes --json` prints, as \"modes.speeds.0.modes.*.damping_ratio\"");
  }
  return path;
}

std::optional<double> figure_value(const FigurePath& path, const json& all, bool largest) {
  std::vector<double> numbers;
  if (!gather(all, path.parts, numbers) || numbers.empty()) return std::nullopt;
  const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
  return largest ? *high : *low;
}

}  // namespace rotorub::optimise
