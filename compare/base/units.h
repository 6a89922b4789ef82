// The units in which people read speeds, frequencies, lengths and times.
#pragma once

#include <numbers>
#include <string>
#include <string_view>

namespace rotorub {

inline constexpr double kRpm = 30.0 / std::numbers::pi;  // rpm per rad/s
inline constexpr double kMilli = 1e3;                    // mm per m, ms per s
inline constexpr double kMicro = 1e6;                    // µm per m, µs per s
inline constexpr double kHz = 0.5 / std::numbers::pi;    // Hz per rad/s

// How people read a value in an SI unit: Hz for rad/s.
struct ShownUnit {
  std::string name;
  double per_si = 1.0;
};
inline ShownUnit shown_unit(std::string_view unit) {
  if (unit == "rad/s") return {"Hz", kHz};
  return {std::string(unit), 1.0};
}

// "stator.mass / kg"; the name alone without a unit.
inline std::string name_and_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " / " + unit;
}

}  // namespace rotorub
