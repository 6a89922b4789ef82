#include "compare/modes/levitation_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "compare/base/units.h"
#include "compare/modes/whirl_tables.h"

namespace rotorub {
namespace {

using nlohmann::json;
using result::line;
using result::number;

constexpr double kPoleRoundOff = 1e-10;  // of a pole, as a share of the largest

double largest_pole(const std::vector<std::complex<double>>& poles) {
  double size = 0.0;
  for (const auto& s : poles) size = std::max(size, std::abs(s));
  return size;
}

// The poles with Im >= 0, by rising absolute value.
std::vector<std::complex<double>> shown_poles(const Levitation& levitation) {
  std::vector<std::complex<double>> shown;
  for (const auto& s : levitation.poles) {
    if (s.imag() >= 0.0) shown.push_back(s);
  }
  std::sort(shown.begin(), shown.end(),
            [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); });
  return shown;
}

// The poles with parts that are only round-off set to 0.
void clear_round_off(std::vector<std::complex<double>>& poles) {
  const double least = kPoleRoundOff * largest_pole(poles);
  for (auto& s : poles) {
    s = {std::abs(s.real()) < least ? 0.0 : s.real(), std::abs(s.imag()) < least ? 0.0 : s.imag()};
  }
}

std::vector<result::Part> pole_parts(const Levitation& levitation) {
  constexpr std::size_t kRows = 20;
  auto poles = shown_poles(levitation);
  clear_round_off(poles);
  const std::size_t left = poles.size() - std::min(kRows, poles.size());
  poles.resize(poles.size() - left);
  result::Table table;
  const auto add = result::column_adder(table, poles);
  add({"", "real / 1/s", 16}, [](auto& s) { return number(s.real(), 6); });
  add({"", "imag / rad/s", 14}, [](auto& s) { return number(s.imag(), 6); });
  add({"", "Hz", 14}, [](auto& s) { return number(s.imag(), 6, kHz); });
  add({"", "damping ratio", 16},
      [](auto& s) { return number(std::abs(s) > 0.0 ? -s.real() / std::abs(s) : 0.0, 4); });
  std::vector<result::Part> parts{table};
  if (left > 0)
    parts.push_back(line(fmt::format("  and {} faster ones, in the output of --json", left)));
  return parts;
}

// Whether the sensitivities are those of a stable loop.
std::vector<result::Part> validity_parts(const Levitation& levitation) {
  if (levitation.unstable()) {
    return {
        line("  The closed loop is unstable, so it has no sensitivity and no zone of ISO "
             "14839-3.")};
  }
  if (!levitation.poles_refused.empty() && !levitation.loops.empty())
    return {line("  Its stability is unknown; the sensitivities are valid only if it is stable.")};
  return {};
}

// A row per loop, which begins with the bearing and the axis.
result::Table loops_table(const Levitation& levitation, std::string place) {
  result::Table table{.place = std::move(place)};
  for (std::size_t k = 0; k < levitation.loops.size(); ++k)
    table.rows.push_back({.key = std::to_string(k)});
  const auto add = result::column_adder(table, levitation.loops);
  add({"", "bearing", -12}, [](auto& l) {
    return result::Item{l.bearing + 1, std::to_string(l.bearing + 1)};
  });
  add({"", "axis", -6}, [](auto& l) { return result::Item{l.axis == 0 ? "x" : "y"}; });
  return table;
}

result::Table sensitivity_table(const Levitation& levitation) {
  result::Table table = loops_table(levitation, "loops/#/{column}");
  table.columns[0].key = "bearing";
  table.columns[1].key = "axis";
  const auto add = result::column_adder(table, levitation.loops);
  if (levitation.unstable()) {
    for (const char* key : {"sensitivity", "frequency", "zone"})
      add({key}, [](auto&) { return result::Item{nullptr}; });
    table.seen = result::kJson;
    return table;
  }
  add({"sensitivity", "largest |S|", 16}, [](auto& s) { return number(s.peak, 4); });
  add({"", "dB", 10}, [](auto& s) { return number(20.0 * std::log10(s.peak), 3); });
  add({"frequency", "at Hz", 14}, [](auto& s) { return number(s.frequency, 5, kHz); });
  add({"zone", "zone of ISO 14839-3", 22},
      [](auto& s) { return result::Item{std::string(1, sensitivity_zone(s.peak))}; });
  return table;
}

std::vector<result::Part> step_parts(const Levitation& levitation) {
  result::Table table = loops_table(levitation, "loops/{row}/step/{column}");
  const auto add = result::column_adder(table, levitation.steps);
  add({"largest", "largest µm/N", 13}, [](auto& s) { return number(s.largest, 4, kMicro); });
  add({"largest_at", "at ms", 10}, [](auto& s) { return number(s.largest_at, 4, kMilli); });
  add({"rise_time", "rise ms", 10}, [](auto& s) { return number(s.rise_time, 4, kMilli); });
  add({"overshoot", "overshoot %", 13}, [](auto& s) { return number(s.overshoot, 4, 100.0); });
  add({"settling_time", "settling ms", 12},
      [](auto& s) { return number(s.settling_time, 4, kMilli); });
  add({"steady", "steady µm/N", 12}, [](auto& s) { return number(s.steady, 4, kMicro); });
  add({"static_stiffness", "stiffness N/m", 15},
      [](auto& s) { return number(s.static_stiffness(), 4); });
  std::vector<result::Part> parts{
      line("  step of force on the rotor at each bearing: its deflection there per newton, settled "
           "within 2 %",
           result::Role::kCaption),
      table};
  if (std::ranges::any_of(levitation.steps, [](const auto& s) { return !s.overshoot; }))
    parts.push_back(
        line("  overshoot -: the deflection returns to about 0, and settles within 2 % of its "
             "largest value"));
  return parts;
}

std::vector<result::Part> unbalance_parts(const Levitation& levitation) {
  result::Table table = loops_table(levitation, "");
  const auto add = result::column_adder(table, levitation.unbalance);
  add({"", "µm peak to peak", 17}, [](double value) { return number(value, 4, kMicro); });
  return {line("  unbalance response at the sensors", result::Role::kCaption), table};
}

json poles_json(const Levitation& levitation) {
  if (!levitation.poles_refused.empty()) return nullptr;
  json poles = json::array();
  for (const auto& s : levitation.poles)
    poles.push_back({{"real", s.real()}, {"imaginary", s.imag()}});
  return poles;
}

}  // namespace

bool has_loop(const Levitation& levitation) {
  return !levitation.loops.empty() || !levitation.poles_refused.empty();
}

bool has_poles(const Levitation& levitation) {
  return has_loop(levitation) && levitation.poles_refused.empty();
}

std::string instability_text(double speed, const Levitation& levitation) {
  if (!levitation.poles_refused.empty())
    return fmt::format("Stability is unknown, because {}.", levitation.poles_refused);
  if (!levitation.unstable()) return "";
  const std::complex<double>& worst = levitation.poles.front();
  const double at = std::abs(worst.imag()),
               round_off = kPoleRoundOff * largest_pole(levitation.poles);
  return fmt::format(
      "The closed loop of the magnetic bearings is unstable at {:.6g} rpm: {} {}.",
      std::abs(speed) * kRpm,
      at > round_off ? fmt::format("a motion at {:.5g} rad/s", at) : "a motion without oscillation",
      worst.real() > round_off ? fmt::format("grows at {:.4g} 1/s", worst.real())
                               : "does not decay");
}

result::Section levitation_section(double speed, const Levitation& levitation) {
  using result::Data;
  const std::string& refused = levitation.poles_refused;
  result::Section section{
      "levitation",
      {Data{"sample_time", levitation.sample_time}, Data{"poles", poles_json(levitation)},
       Data{"poles_refused", text_or_null(refused)}, Data{"loops", json::array()},
       line(fmt::format("\nclosed loop of the magnetic bearings at {:.6g} rad/s{}", speed,
                        levitation.sample_time > 0.0
                            ? fmt::format(", sampled every {:.4g} s", levitation.sample_time)
                            : ""),
            result::Role::kHeading)}};
  if (!refused.empty())
    section.add({line(fmt::format("  The poles are unknown, because {}.", refused))});
  if (refused.empty()) section.add(pole_parts(levitation));
  section.add(validity_parts(levitation));
  if (!levitation.loops.empty()) section.add({sensitivity_table(levitation)});
  if (!levitation.steps.empty()) {
    section.add(step_parts(levitation));
    if (!levitation.unbalance.isZero(0.0)) section.add(unbalance_parts(levitation));
  }
  const bool stands = !levitation.steps.empty();
  for (std::size_t k = 0; k < levitation.loops.size(); ++k) {
    const std::string loop = fmt::format("loops/{}/", k);
    if (!stands) section.add({Data{loop + "step", nullptr}});
    section.add({Data{loop + "unbalance",
                      stands ? json(levitation.unbalance[static_cast<Eigen::Index>(k)]) : json()}});
  }
  return section;
}

}  // namespace rotorub
