#include "compare/modes/levitation_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "compare/base/json.h"
#include "compare/base/units.h"

namespace rotorub {
namespace {

using nlohmann::json;

constexpr double kMicro = 1e6;

const char* axis_of(const LoopSensitivity& loop) { return loop.axis == 0 ? "x" : "y"; }

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

json step_json(const StepResponse& step) {
  return {{"largest", step.largest},
          {"largest_at", number_or_null(step.largest_at)},
          {"steady", step.steady},
          {"static_stiffness", number_or_null(step.static_stiffness())},
          {"rise_time", number_or_null(step.rise_time)},
          {"overshoot", number_or_null(step.overshoot)},
          {"settling_time", step.settling_time}};
}

std::string or_dash(const std::optional<double>& value, double factor) {
  return value ? fmt::format("{:.4g}", factor * *value) : "-";
}

LoopSheet pole_sheet(const Levitation& levitation) {
  constexpr std::size_t kRows = 20;
  const auto poles = shown_poles(levitation);
  LoopSheet sheet{
      "", {{"real / 1/s", 14}, {"imag / rad/s", 14}, {"Hz", 14}, {"damping ratio", 16}}, {}, {}};
  for (std::size_t k = 0; k < std::min(kRows, poles.size()); ++k) {
    const auto& s = poles[k];
    sheet.rows.push_back(
        {fmt::format("{:.6g}", s.real()), fmt::format("{:.6g}", s.imag()),
         fmt::format("{:.6g}", s.imag() * kHz),
         fmt::format("{:.4g}", std::abs(s) > 0.0 ? -s.real() / std::abs(s) : 0.0)});
  }
  if (poles.size() > kRows)
    sheet.notes.push_back(
        fmt::format("and {} faster ones, in the output of --json", poles.size() - kRows));
  if (!levitation.stable())
    sheet.notes.push_back("it is unstable, so there are no sensitivities of a working loop");
  return sheet;
}

// Rows begin with the bearing and the axis of the loop; cells(k) returns the cells of loop k.
template <class Cells>
LoopSheet sheet_of_loops(const Levitation& levitation, std::string caption,
                         std::vector<LoopSheet::Column> columns, const Cells& cells) {
  columns.insert(columns.begin(), {{"bearing", -10}, {"axis", -6}});
  LoopSheet sheet{std::move(caption), std::move(columns), {}, {}};
  for (std::size_t k = 0; k < levitation.loops.size(); ++k) {
    const LoopSensitivity& loop = levitation.loops[k];
    std::vector<std::string>& row = sheet.rows.emplace_back(
        std::vector{fmt::format("{}", loop.bearing + 1), std::string(axis_of(loop))});
    for (std::string& cell : cells(k)) row.push_back(std::move(cell));
  }
  return sheet;
}

LoopSheet sensitivity_sheet(const Levitation& levitation) {
  return sheet_of_loops(
      levitation, "", {{"most of |S|", 16}, {"dB", 10}, {"at Hz", 14}, {"zone of ISO 14839-3", 22}},
      [&](std::size_t k) {
        const LoopSensitivity& loop = levitation.loops[k];
        return std::vector{fmt::format("{:.4g}", loop.peak),
                           fmt::format("{:.3g}", 20.0 * std::log10(loop.peak)),
                           fmt::format("{:.5g}", loop.frequency * kHz),
                           std::string(1, sensitivity_zone(loop.peak))};
      });
}

LoopSheet step_sheet(const Levitation& levitation) {
  LoopSheet sheet =
      sheet_of_loops(levitation,
                     "step of force on the rotor at each bearing: how far it goes there per "
                     "newton, settled within "
                     "2 %",
                     {{"most um/N", 13},
                      {"at ms", 10},
                      {"rises ms", 10},
                      {"overshoot %", 13},
                      {"settles ms", 12},
                      {"stays um/N", 12},
                      {"stiffness N/m", 15}},
                     [&](std::size_t k) {
                       const StepResponse& step = levitation.steps[k];
                       return std::vector{fmt::format("{:.4g}", kMicro * step.largest),
                                          or_dash(step.largest_at, kMilli),
                                          or_dash(step.rise_time, kMilli),
                                          or_dash(step.overshoot, 100.0),
                                          fmt::format("{:.4g}", kMilli * step.settling_time),
                                          fmt::format("{:.4g}", kMicro * step.steady),
                                          or_dash(step.static_stiffness(), 1.0)};
                     });
  if (std::ranges::any_of(levitation.steps, [](const auto& s) { return !s.overshoot; }))
    sheet.notes.push_back(
        "overshoot -: it goes back to about 0, and has settled within 2 % of its largest value");
  return sheet;
}

LoopSheet unbalance_sheet(const Levitation& levitation) {
  return sheet_of_loops(
      levitation, "unbalance response at the sensors", {{"um peak to peak", 17}},
      [&](std::size_t k) {
        return std::vector{
            fmt::format("{:.4g}", kMicro * levitation.unbalance[static_cast<Eigen::Index>(k)])};
      });
}

}  // namespace

json levitation_json(const Levitation& levitation) {
  if (levitation.loops.empty() && levitation.poles_refused.empty()) return nullptr;
  json poles = json::array(), loops = json::array();
  for (const auto& s : levitation.poles) {
    poles.push_back({{"real", s.real()}, {"imaginary", s.imag()}});
  }
  for (std::size_t k = 0; k < levitation.loops.size(); ++k) {
    const LoopSensitivity& loop = levitation.loops[k];
    const bool stands = !levitation.steps.empty();
    loops.push_back({{"bearing", loop.bearing + 1},
                     {"axis", axis_of(loop)},
                     {"sensitivity", loop.peak},
                     {"frequency", loop.frequency},
                     {"zone", std::string(1, sensitivity_zone(loop.peak))},
                     {"step", stands ? step_json(levitation.steps[k]) : json(nullptr)},
                     {"unbalance", stands ? json(levitation.unbalance[static_cast<Eigen::Index>(k)])
                                          : json(nullptr)}});
  }
  const bool refused = !levitation.poles_refused.empty();
  return {{"poles", refused ? json(nullptr) : poles},
          {"poles_refused", refused ? json(levitation.poles_refused) : json(nullptr)},
          {"sample_time", levitation.sample_time},
          {"loops", loops}};
}

std::string levitation_title(double speed, const Levitation& levitation) {
  return fmt::format("closed loop of the magnetic bearings at {:.6g} rad/s{}", speed,
                     levitation.sample_time > 0.0
                         ? fmt::format(", sampled every {:.4g} s", levitation.sample_time)
                         : "");
}

std::vector<LoopSheet> levitation_sheets(const Levitation& levitation) {
  std::vector<LoopSheet> sheets;
  if (levitation.poles_refused.empty()) sheets.push_back(pole_sheet(levitation));
  if (!levitation.loops.empty()) sheets.push_back(sensitivity_sheet(levitation));
  if (levitation.steps.empty()) return sheets;
  sheets.push_back(step_sheet(levitation));
  if (!levitation.unbalance.isZero(0.0)) sheets.push_back(unbalance_sheet(levitation));
  return sheets;
}

std::string levitation_table(double speed, const Levitation& levitation) {
  if (levitation.loops.empty() && levitation.poles_refused.empty()) return "";
  std::string text = "\n" + levitation_title(speed, levitation) + "\n";
  if (!levitation.poles_refused.empty())
    text += fmt::format("  poles: none, {}\n", levitation.poles_refused);
  for (const LoopSheet& sheet : levitation_sheets(levitation)) {
    if (!sheet.caption.empty()) text += "  " + sheet.caption + "\n";
    const auto add = [&](std::size_t column, const std::string& cell) {
      const int width = sheet.columns[column].width;
      text += width < 0 ? fmt::format("{:<{}}", cell, -width) : fmt::format("{:>{}}", cell, width);
    };
    text += "  ";
    for (std::size_t k = 0; k < sheet.columns.size(); ++k) add(k, sheet.columns[k].head);
    for (const std::vector<std::string>& row : sheet.rows) {
      text += "\n  ";
      for (std::size_t k = 0; k < row.size(); ++k) add(k, row[k]);
    }
    text += "\n";
    for (const std::string& note : sheet.notes) text += "  " + note + "\n";
  }
  return text;
}

}  // namespace rotorub
