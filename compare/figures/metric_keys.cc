#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <deque>
#include <nlohmann/json.hpp>
#include <vector>

#include "compare/figures/figure.h"

namespace rotorub {
namespace {

using nlohmann::json;

// Metrics of a run besides its figures and residuals; "settled.from" is within "settled".
struct MetricKey {
  const char *key, *unit, *meaning;
  json (*value)(const Metrics&);
  bool is_timing = false;
};
json figure_json(const Figure& figure, const Metrics& m) {
  const double value = figure.value(m);
  const bool is_count = !*figure.unit && std::isfinite(value);
  return is_count ? json(std::llround(value)) : json(value);
}
// null where an optional member is empty.
template <auto Member>
json read(const Metrics& m) {
  if constexpr (requires { *(m.*Member); }) {
    return m.*Member ? json(*(m.*Member)) : json();
  } else {
    return m.*Member;
  }
}
template <auto Member>
json settled_at(const Metrics& m) {
  return m.settled.*Member;
}
const MetricKey kMetricKeys[] = {
    {"end", "s", "time reached", read<&Metrics::end>},
    {"step", "s", "fixed step; 0: event", read<&Metrics::step>},
    {"steps", "", "number of steps taken", read<&Metrics::steps>},
    {"wall_s", "s", "computing time; not a result", read<&Metrics::wall_s>, true},
    {"us_per_step", "us", "computing time of a step; not a result", read<&Metrics::us_per_step>,
     true},
    {"first_touch", "s", "time of the first touch; null: never", read<&Metrics::first_touch>},
    {"least_gap", "m", "smallest gap of all rows and ends of steps; null: no [contact]",
     read<&Metrics::least_gap>},
    {"peak_impulse", "N s", "largest normal impulse of one impact", read<&Metrics::peak_impulse>},
    {"friction_impulse", "N s", "friction impulse on the rotor along e_t",
     read<&Metrics::friction_impulse>},
    {"forward_passes", "",
     "turns of the rotor around its ring from first touch; most of several contacts",
     read<&Metrics::forward_passes>},
    {"backward_passes", "",
     "turns of the rotor around its ring from first touch; most of several contacts",
     read<&Metrics::backward_passes>},
    {"whirl_time", "s", "time that these turns took", read<&Metrics::whirl_time>},
    {"real_time_factor", "", "simulated time / computing time; not a result",
     read<&Metrics::real_time_factor>, true},
    {"settled.attractor", "",
     "motion in the last fifth: no contact, bouncing, resting, synchronous rub, forward "
     "rub, backward whip, rolling or unknown",
     [](const Metrics& m) { return json(to_string(m.settled.attractor)); }},
    {"settled.from", "s", "start of the last fifth", settled_at<&Settled::from>},
    {"settled.contact_share", "", "share of the last fifth's rows in contact",
     settled_at<&Settled::contact_share>},
    {"settled.whirl_frequency", "rad/s",
     "mean whirl over the last fifth, forward positive, at the contact closed longest",
     settled_at<&Settled::whirl_frequency>},
    {"settled.spin_speed", "rad/s", "mean spin speed over the last fifth",
     settled_at<&Settled::spin_speed>},
    {"settled.impacts", "", "impacts in the last fifth", settled_at<&Settled::impacts>},
    {"residuals.force_scale", "N",
     "mean normal force of the rows in contact, F below; delta_0: clearance",
     [](const Metrics& m) { return json(m.residuals.force_scale); }},
};

std::vector<ColumnMeaning> make_metric_keys() {
  static std::deque<std::string> names;  // storage for the keys' names
  std::vector<ColumnMeaning> keys;
  for (const Figure& f : figures()) keys.push_back({f.key, figure_si_unit(f), f.meaning, ""});
  for (const MetricKey& k : kMetricKeys) keys.push_back({k.key, k.unit, k.meaning, ""});
  for (const ResidualFigure& r : residual_figures()) {
    keys.push_back({names.emplace_back(fmt::format("residuals.{}", r.key)), "", r.definition, ""});
  }
  return keys;
}

}  // namespace

const ColumnMeaning& metric_key(std::string_view key) {
  const auto keys = metric_keys();
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const ColumnMeaning& k) { return k.name == key; });
  assert(found != keys.end());
  return *found;
}

bool is_timing(std::string_view key) {
  return std::any_of(std::begin(kMetricKeys), std::end(kMetricKeys),
                     [&](const MetricKey& k) { return k.is_timing && k.key == key; });
}

json metric_value(const Metrics& m, std::string_view key) {
  for (const MetricKey& k : kMetricKeys)
    if (k.key == key) return k.value(m);
  const Figure& f = figure(std::string(key));
  return has_figure(m, f) ? figure_json(f, m) : json(nullptr);
}

json metrics_json(const Metrics& m) {
  json all = {{"residuals", residuals_json(m.residuals)}};
  for (const Figure& f : figures()) all[f.key] = figure_json(f, m);
  for (const MetricKey& k : kMetricKeys) {
    std::string path = fmt::format("/{}", k.key);
    std::replace(path.begin(), path.end(), '.', '/');
    all[json::json_pointer(path)] = k.value(m);
  }
  return all;
}

std::span<const ColumnMeaning> metric_keys() {
  static const std::vector<ColumnMeaning> keys = make_metric_keys();
  return keys;
}

}  // namespace rotorub
