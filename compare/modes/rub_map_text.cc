#include "compare/modes/rub_map_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "compare/base/units.h"
#include "compare/modes/rub_analysis.h"

namespace rotorub {
namespace {

using nlohmann::json;

// By the set's bits (rub::Attractor): with rolling, which is nearly everywhere, a capital.
constexpr std::array<char, 16> kLetters = {'-', '.', 'r', 'b', 'w', 'v', 'x', 'a',
                                           'o', 'O', 'R', 'B', 'W', 'V', 'X', 'A'};

}  // namespace

json rub_map_json(const rub::RubMap& map) {
  json points = json::array();
  for (const rub::RubPoint& point : map.points) points.push_back(rub_point_json(point));
  return {{"speeds", map.speeds}, {"frictions", map.frictions}, {"points", points}};
}

std::string rub_map_picture(const std::string& name, const rub::RubMap& map) {
  std::string text = fmt::format("{}: what is stable, by the rubs' eigenvalues\n\n", name);
  std::array<int, 16> met{};
  for (std::size_t f = map.frictions.size(); f-- > 0;) {
    text += fmt::format("{:>9.4g} |", map.frictions[f]);
    for (std::size_t s = 0; s < map.speeds.size(); ++s) {
      const unsigned attractors = map.at(s, f).attractors();
      ++met[attractors];
      text += kLetters[attractors];
    }
    text += "\n";
  }
  const std::string low = fmt::format("{:.4g} Hz", map.speeds.front() * kHz);
  const std::string high = fmt::format("{:.4g} Hz", map.speeds.back() * kHz);
  const std::size_t wide = std::max(map.speeds.size(), low.size() + high.size() + 2);
  text += fmt::format(" friction +{}\n{:>11}{}{:>{}}\n\n", std::string(map.speeds.size(), '-'), "",
                      low, high, wide - low.size());
  for (unsigned k = 0; k < met.size(); ++k) {
    if (met[k] == 0) continue;
    text += fmt::format("  {}  {:<60}{:>6.1f} %\n", kLetters[k], attractors_text(k),
                        100.0 * met[k] / static_cast<double>(map.points.size()));
  }
  return text +
         "\nAcross: spin speed, held, the loads in their ratio to it. Stable against what is "
         "small, the "
         "contact kept;\na bounce may lead elsewhere.\n";
}

}  // namespace rotorub
