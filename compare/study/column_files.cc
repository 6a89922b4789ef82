#include "compare/study/column_files.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "compare/base/columns.h"
#include "compare/measured/json.h"
#include "compare/study/figure.h"

namespace rotorub {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view kGeometry = "geometry form with a contact, else null";

const ColumnMeaning kSummary[] = {
    {"program", "", "rotorub", ""},
    {"version", "", "of the program", ""},
    {"mujoco_version", "", "of the MuJoCo that it runs with", ""},
    {"scene", "", "name of the scene", ""},
    {"scene_hash", "", "16 hexadecimal digits of the scene's text, overrides included", ""},
    {"engine", "", "native or mujoco", ""},
    {"integrator", "", "of the engine", ""},
    {"contact_model", "", "rigid, coulomb, cone or cone-coulomb", ""},
    {"step", "s", "fixed step; 0 for event", ""},
    {"steps", "", "number of steps taken", ""},
    {"end", "s", "time reached", ""},
    {"wall_s", "s", "time of the integration; no result", ""},
    {"us_per_step", "us", "the same for a step; no result", ""},
    {"max_penetration", "m", "deepest penetration, never negative", ""},
    {"contact_fraction", "", "share of the time from first touch with a normal force; an impact of a fixed step counts "
     "as one step", ""},
    {"mean_force", "N", "normal impulse over the time from first touch", ""},
    {"impulse_total", "N s", "all normal impulse on the rotor, never negative", ""},
    {"impacts", "", "number of impacts with a gap rate below -1e-4 m/s", ""},
    {"energy_residual", "", "imbalance of the energy over the largest energy met", ""},
    {"contact_mass.kept", "kg", "mass that an impact meets, of the modes kept", kGeometry},
    {"contact_mass.mesh", "kg", "the same of all modes of the mesh", kGeometry},
    {"contact_mass.kept_modes", "", "number of modes kept", kGeometry},
    {"contact_mass.mesh_modes", "", "number of modes of the mesh", kGeometry},
    {"above_modes.highest_forward", "rad/s", "fastest forward whirl of the modes kept, positive", kGeometry},
    {"above_modes.highest_backward", "rad/s", "fastest backward whirl of the modes kept, positive", kGeometry},
    {"above_modes.contact_share", "", "share of the time in contact whose whirl is faster than these", kGeometry},
    {"above_modes.friction_share", "", "share of the friction work there", kGeometry},
    {"above_modes.fastest_whirl", "rad/s", "fastest whirl in contact, forward positive", kGeometry},
    {"ring_speed", "rad/s", "speed of the ring's own spin at the end, positive as the rotor's", "a ring that turns"},
    {"status", "", "ok, diverged, no_solution, ambiguous, step_too_large, out_of_range, controller_failed or "
     "interrupted", ""},
    {"message", "", "why it is not ok", ""},
};

// The written unit of a figure, brought back to SI.
std::string_view si_unit(const Figure& figure) {
  if (figure.per_unit == 1.0) return figure.unit;
  const std::string_view unit = figure.unit;
  if (unit == "mm/s") return "m/s";
  if (unit == "Hz") return "rad/s";
  if (unit == "\u00b5m") return "m";
  return "";  // %, ppm
}

std::vector<ColumnMeaning> make_metric_keys() {
  std::vector<ColumnMeaning> keys;
  for (const Figure& f : figures()) keys.push_back({f.key, si_unit(f), f.meaning, ""});
  const ColumnMeaning more[] = {
      {"first_touch", "s", "time of the first contact; null: never", ""},
      {"least_gap", "m", "smallest gap of all rows and ends of steps; 0 or, by penetration, less where it touched; null: no [contact]", ""},
      {"friction_impulse", "N s", "on the rotor, signed along e_t", ""},
      {"real_time_factor", "", "simulated time over time taken; no result", ""},
      {"settled.attractor", "", "what the last fifth of the run is", ""},
      {"settled.from", "s", "where that begins", ""},
      {"settled.contact_share", "", "share of its rows in contact", ""},
      {"settled.whirl_frequency", "rad/s", "mean whirl there, forward positive", ""},
      {"settled.spin_speed", "rad/s", "mean spin speed there", ""},
      {"settled.impacts", "", "counted impacts there", ""},
      {"residuals.force_scale", "N", "mean normal force of the rows in contact: F below, delta_0 the clearance", ""},
      {"residuals.penetration", "", "largest penetration / delta_0 of a row", ""},
      {"residuals.adhesion", "", "largest pull / F", ""},
      {"residuals.complementarity", "", "largest gap times force / (delta_0 F)", ""},
      {"residuals.cone", "", "largest |friction| beyond mu times normal force / F", ""},
      {"residuals.sliding", "", "largest departure from Coulomb's law where it slides / F", ""},
      {"residuals.power", "", "largest power that friction gave, over F times the largest slip", ""},
      {"residuals.gap_error", "", "largest |gap - (delta_0 - distance of the centres)| / delta_0", ""},
  };
  keys.insert(keys.end(), std::begin(more), std::end(more));
  return keys;
}

std::string section(std::string_view file, std::span<const ColumnMeaning> columns) {
  return fmt::format("### `{}`\n\n{}\n", file, columns_table(columns));
}

}  // namespace

std::span<const ColumnMeaning> summary_keys() { return kSummary; }

std::span<const ColumnMeaning> metric_keys() {
  static const std::vector<ColumnMeaning> keys = make_metric_keys();
  return keys;
}

ordered_json run_columns_json(const Trajectory& trajectory) {
  ordered_json series = ordered_json::array();
  for (const Column& c : trajectory.series) {
    series.push_back(column_json(c.name, c.unit, series_column(c.name).meaning));
  }
  return {{"series.csv", series},
          {"impacts.csv", columns_json(impact_columns())},
          {"events.csv", columns_json(event_columns())},
          {"summary.json", columns_json(summary_keys())}};
}

ordered_json compare_columns_json() {
  return {{"compare.json runs.*.metrics", columns_json(metric_keys())},
          {"compare.json runs.*.summary", columns_json(summary_keys())},
          {"compare.json measured", columns_json(measured_keys())}};
}

std::string columns_markdown() {
  return section("series.csv", series_columns()) + section("impacts.csv", impact_columns()) +
         section("events.csv", event_columns()) + section("summary.json", summary_keys()) +
         section("compare.json: metrics of a run", metric_keys()) +
         section("compare.json: a measured run", measured_keys());
}

}  // namespace rotorub
