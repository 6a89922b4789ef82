#include "compare/modes/levitation_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "compare/base/units.h"

namespace rotorub {
namespace {

using nlohmann::json;

const char* axis_of(const LoopSensitivity& loop) { return loop.axis == 0 ? "x" : "y"; }

// Those of pairs with Im > 0, by their size.
std::vector<std::complex<double>> shown_poles(const Levitation& levitation) {
  std::vector<std::complex<double>> shown;
  for (const auto& s : levitation.poles) {
    if (s.imag() >= 0.0) shown.push_back(s);
  }
  std::sort(shown.begin(), shown.end(),
            [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); });
  return shown;
}

}  // namespace

json levitation_json(const Levitation& levitation) {
  if (levitation.loops.empty() && levitation.poles_refused.empty()) return nullptr;
  json poles = json::array(), loops = json::array();
  for (const auto& s : levitation.poles) {
    poles.push_back({{"real", s.real()}, {"imaginary", s.imag()}});
  }
  for (const LoopSensitivity& loop : levitation.loops) {
    loops.push_back({{"bearing", loop.bearing + 1},
                     {"axis", axis_of(loop)},
                     {"sensitivity", loop.peak},
                     {"frequency", loop.frequency},
                     {"zone", std::string(1, sensitivity_zone(loop.peak))}});
  }
  const bool refused = !levitation.poles_refused.empty();
  return {{"poles", refused ? json(nullptr) : poles},
          {"poles_refused", refused ? json(levitation.poles_refused) : json(nullptr)},
          {"sample_time", levitation.sample_time},
          {"loops", loops}};
}

std::string levitation_table(double speed, const Levitation& levitation) {
  if (levitation.loops.empty() && levitation.poles_refused.empty()) return "";
  std::string text = fmt::format(
      "\nclosed loop of the magnetic bearings at {:.6g} rad/s{}\n", speed,
      levitation.sample_time > 0.0 ? fmt::format(", sampled every {:.4g} s", levitation.sample_time)
                                   : "");
  if (!levitation.poles_refused.empty()) {
    text += fmt::format("  poles: none, {}\n", levitation.poles_refused);
  } else {
    constexpr std::size_t kRows = 20;
    const auto poles = shown_poles(levitation);
    text += fmt::format("  {:>14}{:>14}{:>14}{:>16}\n", "real / 1/s", "imag / rad/s", "Hz",
                        "damping ratio");
    for (std::size_t k = 0; k < std::min(kRows, poles.size()); ++k) {
      const auto& s = poles[k];
      text += fmt::format("  {:>14.6g}{:>14.6g}{:>14.6g}{:>16.4g}\n", s.real(), s.imag(),
                          s.imag() * kHz, std::abs(s) > 0.0 ? -s.real() / std::abs(s) : 0.0);
    }
    if (poles.size() > kRows) {
      text += fmt::format("  and {} faster ones, in the output of --json\n", poles.size() - kRows);
    }
    if (!levitation.stable())
      text += "  it is unstable: sensitivities are of no loop that stands\n";
  }
  if (levitation.loops.empty()) return text;
  text += fmt::format("  {:<10}{:<6}{:>16}{:>10}{:>14}{:>22}\n", "bearing", "axis", "most of |S|",
                      "dB", "at Hz", "zone of ISO 14839-3");
  for (const LoopSensitivity& loop : levitation.loops) {
    text += fmt::format("  {:<10}{:<6}{:>16.4g}{:>10.3g}{:>14.5g}{:>22}\n", loop.bearing + 1,
                        axis_of(loop), loop.peak, 20.0 * std::log10(loop.peak),
                        loop.frequency * kHz, sensitivity_zone(loop.peak));
  }
  return text;
}

}  // namespace rotorub
