#include "compare/figures/json.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "compare/base/json.h"
#include "compare/figures/figure.h"

namespace rotorub {
namespace {

using nlohmann::json;

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
      {"least_gap", "m",
       "smallest gap of all rows and ends of steps; 0 or, by penetration, less where it touched; "
       "null: no [contact]",
       ""},
      {"friction_impulse", "N s", "on the rotor, signed along e_t", ""},
      {"real_time_factor", "", "simulated time over time taken; no result", ""},
      {"settled.attractor", "", "what the last fifth of the run is", ""},
      {"settled.from", "s", "where that begins", ""},
      {"settled.contact_share", "", "share of its rows in contact", ""},
      {"settled.whirl_frequency", "rad/s", "mean whirl there, forward positive", ""},
      {"settled.spin_speed", "rad/s", "mean spin speed there", ""},
      {"settled.impacts", "", "counted impacts there", ""},
      {"residuals.force_scale", "N",
       "mean normal force of the rows in contact: F below, delta_0 the clearance", ""},
      {"residuals.penetration", "", "largest penetration / delta_0 of a row", ""},
      {"residuals.adhesion", "", "largest pull / F", ""},
      {"residuals.complementarity", "", "largest gap times force / (delta_0 F)", ""},
      {"residuals.cone", "", "largest |friction| beyond mu times normal force / F", ""},
      {"residuals.sliding", "", "largest departure from Coulomb's law where it slides / F", ""},
      {"residuals.power", "", "largest power that friction gave, over F times the largest slip",
       ""},
      {"residuals.gap_error", "", "largest |gap - (delta_0 - distance of the centres)| / delta_0",
       ""},
  };
  keys.insert(keys.end(), std::begin(more), std::end(more));
  return keys;
}

}  // namespace

json residuals_json(const Residuals& r) {
  return {{"force_scale", r.force_scale},
          {"penetration", r.penetration},
          {"adhesion", r.adhesion},
          {"complementarity", r.complementarity},
          {"cone", r.cone},
          {"sliding", r.sliding},
          {"power", r.power},
          {"gap_error", r.gap_error}};
}

json metrics_json(const Metrics& m) {
  json all = json::object();
  for (const Figure& f : figures()) all[f.key] = f.value(m);
  all["first_touch"] = number_or_null(m.first_touch);
  all["least_gap"] = number_or_null(m.least_gap);
  all["friction_impulse"] = m.friction_impulse;
  all["real_time_factor"] = m.real_time_factor;
  all["settled"] = {
      {"attractor", to_string(m.settled.attractor)}, {"from", m.settled.from},
      {"contact_share", m.settled.contact_share},    {"whirl_frequency", m.settled.whirl_frequency},
      {"spin_speed", m.settled.spin_speed},          {"impacts", m.settled.impacts}};
  all["residuals"] = residuals_json(m.residuals);
  return all;
}

std::span<const ColumnMeaning> metric_keys() {
  static const std::vector<ColumnMeaning> keys = make_metric_keys();
  return keys;
}

}  // namespace rotorub
