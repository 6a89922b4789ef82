#include "compare/modes/whirl_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/base/units.h"
#include "compare/modes/answers.h"

namespace rotorub {
namespace {

using nlohmann::json;
using result::column_adder, result::Data, result::Item, result::line, result::number, result::Part;
using result::Role, result::Section, result::Sentence, result::Table;

// The number of critical speeds that the terminal lists: those up to a few times the fastest speed
// of the analysis and the next one, and at least the first five.
std::size_t listed(const RotorAnalysis& analysis) {
  constexpr double kFew = 3.0;
  constexpr std::size_t kFirst = 5;
  double fastest = 0.0;
  for (const WhirlSpectrum& s : analysis.spectra) fastest = std::max(fastest, std::abs(s.speed));
  const auto next = std::ranges::find_if(analysis.critical_speeds,
                                         [&](double speed) { return std::abs(speed) > fastest; });
  std::size_t count = next == analysis.critical_speeds.end() ? 0 : 1;
  count += static_cast<std::size_t>(next - analysis.critical_speeds.begin());
  while (count < analysis.critical_speeds.size() &&
         std::abs(analysis.critical_speeds[count]) <= kFew * fastest) {
    ++count;
  }
  return std::max(count, std::min(kFirst, analysis.critical_speeds.size()));
}

std::vector<double> list(const Eigen::VectorXd& values) { return {values.begin(), values.end()}; }

json plane_json(const PlaneShapes& plane) {
  json modes = json::array();
  for (Eigen::Index j = 0; j < plane.frequency.size(); ++j) {
    modes.push_back({{"frequency", plane.frequency[j]},
                     {"shape", list(plane.shape.col(j))},
                     {"at_stations", list(plane.at_stations.col(j))}});
  }
  return modes;
}

// 0 instead of a value that is written as 0.0000, so that it has no sign.
double without_round_off(double value) { return std::abs(value) < 5e-5 ? 0.0 : value; }

// The table divides a mode by this: 1, or the largest deflection if the mode has nearly a node at
// the contact.
double table_scale(const Eigen::VectorXd& shape) {
  constexpr double kNearNode = 10.0;  // largest deflection over the deflection at the contact
  Eigen::Index peak = 0;
  const double largest = shape.cwiseAbs().maxCoeff(&peak);
  return largest > kNearNode ? shape[peak] : 1.0;
}

// One column per mode: its frequency at rest, then its value at each station. In JSON the stations
// at the place, if there is one.
std::vector<Part> plane_parts(const std::string& title, const std::string& place,
                              const std::vector<Station>& stations, const PlaneShapes& plane) {
  constexpr Eigen::Index kColumns = 6;
  Table table{.place = place};
  const auto add = column_adder(table, stations);
  add({.key = "kind", .seen = result::kJson}, [](auto& s) { return Item{to_string(s.kind)}; });
  add({"name", "station", -20}, [](auto& s) { return Item{s.name}; });
  add({"z", "z / mm", 10}, [](auto& s) { return number(s.z, 5, kMilli); });
  for (Eigen::Index j = 0; j < plane.frequency.size(); ++j) {
    const Eigen::VectorXd shown = plane.at_stations.col(j) / table_scale(plane.shape.col(j));
    column_adder(table, shown)(
        {"", fmt::format("{:.5g} Hz", plane.frequency[j] * kHz), 13,
         j < kColumns ? result::kPeople : result::kPage},
        [](double value) { return Item{.text = fmt::format("{:.4f}", without_round_off(value))}; });
  }
  std::vector<Part> parts{
      line("\nmode shapes at rest, scaled to 1 at the contact (to a peak of 1 if the contact is "
           "near a node), " +
               title,
           Role::kHeading),
      table};
  const Eigen::Index left = plane.frequency.size() - kColumns;
  if (left > 0) {
    parts.emplace_back(
        Sentence{.text = fmt::format("  and {} higher modes, which --json prints", left),
                 .wraps = false,
                 .seen = result::kTerminal});
  }
  return parts;
}

}  // namespace

Table whirl_table(const std::string& place, const std::vector<WhirlMode>& modes,
                  const std::function<std::string(const WhirlMode&)>& name_of, bool headed) {
  constexpr double kRoundOff = 1e-9;  // damping ratio of an undamped mode
  Table table{.place = place + "/#/{column}"};
  const auto add = column_adder(table, modes);
  add({.width = -14, .title = "whirl"}, [&](auto& m) { return Item{.text = name_of(m)}; });
  add({.key = "frequency", .width = 14, .title = "rad/s"}, [](auto& m) {
    return Item{m.frequency, fmt::format("{:.7g}", std::abs(m.frequency))};
  });
  add({.width = 14, .title = "Hz"}, [](auto& m) { return number(std::abs(m.frequency), 7, kHz); });
  add({.key = "damping_ratio", .width = 16, .title = "damping ratio"},
      [](auto& m) { return number(m.damping_ratio, 4); });
  for (result::Column& column : table.columns) {
    if (headed) column.heading = column.title;
  }
  add({.seen = result::kPage}, [&](auto& m) {
    return m.damping_ratio < -kRoundOff ? Item{.text = "grows", .tone = Tone::kBad} : Item{};
  });
  return table;
}

std::vector<Part> critical_parts(const RotorAnalysis& analysis) {
  const std::size_t all = analysis.critical_speeds.size(), count = listed(analysis);
  Table table{"critical/#/{column}",
              {{.key = "speed", .seen = result::kNotPage},
               {.width = 14, .seen = result::kPage, .title = "rpm"},
               {.width = 14, .seen = result::kPage, .title = "Hz"},
               {.width = 14, .seen = result::kPage, .title = "rad/s"},
               {.key = "whirl", .title = "whirl"}}};
  for (std::size_t k = 0; k < all; ++k) {
    const double speed = analysis.critical_speeds[k];
    const std::string whirl = to_string(analysis.critical_senses[k]);
    const bool beyond = analysis.table_end > 0.0 && speed > analysis.table_end;
    table.rows.push_back(
        {.items = {{speed, speed_text(speed) + ", "},
                   number(speed, 7, kRpm),
                   number(speed, 7, kHz),
                   number(speed, 7),
                   {whirl, whirl + (beyond ? " (beyond the bearings' tables, so their last values "
                                             "are used)"
                                           : "")}},
         .seen = k < count ? result::kAll : result::kNotTerminal});
  }
  std::vector<Part> parts{
      Data{"critical_speeds", analysis.critical_speeds},
      line(fmt::format("\ncritical speeds that unbalance excites, undamped, up to {} rpm",
                       grouped(analysis.critical_bound * kRpm)),
           Role::kHeading),
      table};
  if (all == 0) parts.emplace_back(line("  none"));
  if (all > count) {
    parts.emplace_back(
        Sentence{.text = fmt::format("  and {} higher critical speed{}, which --json prints",
                                     all - count, all - count > 1 ? "s" : ""),
                 .wraps = false,
                 .seen = result::kTerminal});
  }
  return parts;
}

std::vector<Part> shapes_parts(const std::optional<ModeShapes>& shapes) {
  if (!shapes)
    return {Data{"mode_shapes", nullptr}, line("\nmode shapes: unknown, because the scene gives "
                                               "modes without a shaft; each mode is 1 at "
                                               "the contact")};
  const std::string stations = "stations/#/{column}";
  Section section{"mode_shapes",
                  {Data{"z", list(shapes->z)}, Data{"same_planes", shapes->same_planes},
                   Data{"x", plane_json(shapes->x)}, Data{"y", plane_json(shapes->y)}}};
  if (shapes->same_planes) {
    section.add(plane_parts("planes x and y alike", stations, shapes->stations, shapes->x));
  } else {
    section.add(plane_parts("plane x", stations, shapes->stations, shapes->x));
    section.add(plane_parts("plane y", "", shapes->stations, shapes->y));
  }
  return {section};
}

}  // namespace rotorub
