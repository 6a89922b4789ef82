#include "compare/report/measured_side.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>

#include "compare/base/plot_points.h"
#include "compare/measured/sampled_run.h"
#include "compare/metrics/rows.h"
#include "compare/report/pack/packed_run.h"
#include "compare/report/plots.h"
#include "compare/report/whirl_plots.h"

namespace rotorub {
namespace {

using nlohmann::json;
using Numbers = std::vector<double>;

// One of so many samples is shown.
std::size_t every_shown(std::size_t samples) {
  constexpr std::size_t kMostShown = 50000;
  return (samples + kMostShown - 1) / kMostShown;
}

// Columns of the record that form one track, at the samples where all of them have values.
struct ShownColumns {
  Numbers t;
  std::vector<Numbers> value;
  json holes = json::array();
};

std::optional<ShownColumns> shown_columns(const MeasuredRecord& laid,
                                          std::initializer_list<std::string_view> names) {
  std::vector<const MeasuredColumn*> columns;
  for (const std::string_view name : names) {
    columns.push_back(laid.find(name));
    if (!columns.back()) return std::nullopt;
  }
  const std::size_t every = every_shown(laid.t.size());
  ShownColumns shown;
  shown.value.resize(columns.size());
  bool broken = false;
  for (std::size_t i = 0; i < laid.t.size(); ++i) {
    const bool missing = std::any_of(columns.begin(), columns.end(), [&](const auto* c) {
      return c->sample[i] == Sample::kMissing;
    });
    broken = broken || missing || (i > 0 && laid.t[i] - laid.t[i - 1] > 2.5 * laid.interval);
    if (missing || i % every != 0) continue;
    if (broken && !shown.t.empty()) shown.holes.push_back({shown.t.back(), laid.t[i]});
    broken = false;
    shown.t.push_back(laid.t[i]);
    for (std::size_t c = 0; c < columns.size(); ++c) shown.value[c].push_back(columns[c]->value[i]);
  }
  if (shown.t.size() < 2) return std::nullopt;
  return shown;
}

class SideMaker {
 public:
  SideMaker(const ShownRuns& shown) : shown_(shown), laid_(shown.measured->laid) {}

  json make(double limit) {
    const scene::Scene& scene = *shown_.scene;
    add_even("rotor", {"rotor_x", "rotor_y"}, place_tolerance(scene));
    add_even("ring", {"ring_x", "ring_y"}, place_tolerance(scene));
    if (scene.first().contact) {
      const double least = gap_tolerance(scene.first().contact->clearance);
      add("gap", {"gap"}, [&](const std::vector<Numbers>& value) {
        Numbers tolerance;
        for (const double gap : value.front())
          tolerance.push_back(std::max(least, kShare * std::abs(gap)));
        return tolerance;
      });
      add("force", {kContactForce}, force_tolerance);
      add("normal", {"normal_force"}, force_tolerance);
      add("friction", {"friction_force"}, force_tolerance);
    }
    add("control", {"control_x", "control_y"}, force_tolerance);
    add("current", {"current_1", "current_2"}, force_tolerance);
    add("spin_speed", {"spin_speed"}, [](const std::vector<Numbers>& value) {
      return Numbers(value.front().size(), std::max(range_tolerance(value.front()), 1e-300));
    });
    return {{"label", kMeasured},    {"measured", true},  {"start", laid_.t.front()},
            {"end", laid_.t.back()}, {"tracks", tracks_}, {"holes", holes_},
            {"whirl", whirl(limit)}};
  }

 private:
  template <class Tolerance>
  void add(const char* name, std::initializer_list<std::string_view> columns, Tolerance tolerance) {
    auto found = shown_columns(laid_, columns);
    if (!found) return;
    Numbers bound = tolerance(found->value);
    for (double& b : bound) b = std::max(b, 1e-300);
    tracks_[name] = track_json(pack(
        TrackKind::kLinear, {std::move(found->t), std::move(found->value), {}, std::move(bound)}));
    holes_[name] = std::move(found->holes);
  }
  void add_even(const char* name, std::initializer_list<std::string_view> columns,
                double tolerance) {
    add(name, columns, [&](const std::vector<Numbers>& value) {
      return Numbers(value.front().size(), tolerance);
    });
  }

  // From the second half of the record, as for the other runs; and its distance from the first run
  // at the samples.
  json whirl(double limit) const {
    json all = json::object();
    const auto rotor = shown_columns(laid_, {"rotor_x", "rotor_y"});
    if (!rotor) return all;
    const Numbers &t = rotor->t, &x = rotor->value[0], &y = rotor->value[1];
    const double from = 0.5 * (t.front() + t.back());
    const auto count = static_cast<std::size_t>(t.end() - std::ranges::lower_bound(t, from));
    if (2 * count >= kLeastSpectrumRows) {
      std::vector<std::complex<double>> z;
      for (std::size_t k = 0; k < t.size(); ++k) z.emplace_back(x[k], y[k]);
      all["spectrum"] = spectrum_data(linear(t, z, even_times(from, t.back(), count)),
                                      (t.back() - from) / static_cast<double>(count - 1), limit);
    }
    const SampledRun first(*shown_.runs.front().trajectory);
    const SampleTimes times = sample_times(t, laid_.interval);
    const Numbers first_x = first.values(*laid_.find("rotor_x")->what, times),
                  first_y = first.values(*laid_.find("rotor_y")->what, times);
    Numbers distance;
    for (std::size_t i = 0; i < t.size(); ++i)
      distance.push_back(std::hypot(x[i] - first_x[i], y[i] - first_y[i]));
    all["residual"] = series(t, distance);
    return all;
  }

  const ShownRuns& shown_;
  const MeasuredRecord& laid_;
  json tracks_ = json::object(), holes_ = json::object();
};

}  // namespace

json measured_side(const ShownRuns& shown, double limit) {
  if (!shown.measured) return nullptr;
  return SideMaker(shown).make(limit);
}

json sampled_force(const ShownRuns& shown, const std::string& label) {
  if (!shown.measured || shown.measured->forces.empty()) return nullptr;
  const std::vector<std::string>& labels = shown.measured->labels;
  const auto found = std::find(labels.begin(), labels.end(), label);
  if (found == labels.end()) return nullptr;
  const Numbers& force = shown.measured->forces[static_cast<std::size_t>(found - labels.begin())];
  const Numbers& t = shown.measured->laid.t;
  Samples samples{{}, {{}}, {}, {}};
  for (std::size_t i = 0; i < t.size(); i += every_shown(t.size())) {
    samples.t.push_back(t[i]);
    samples.value[0].push_back(force[i]);
  }
  samples.tolerance = force_tolerance(samples.value);
  return track_json(pack(TrackKind::kLinear, samples));
}

}  // namespace rotorub
