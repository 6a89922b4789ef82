#include "compare/report/run_up_plots.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "compare/base/units.h"
#include "compare/metrics/cascade.h"
#include "compare/metrics/orders.h"
#include "compare/report/plot_points.h"

namespace rotorub {

using nlohmann::json;

constexpr double kMicronsOfRunUp = 1e6;  // um per m

bool changes_speed(const Trajectory& run) {
  constexpr double kChange = 0.1;
  if (run.rows() < 2) return false;
  const std::vector<double>& speed = run.column("spin_speed");
  const auto [low, high] = std::minmax_element(speed.begin(), speed.end());
  return *high - *low >= kChange * std::max(std::abs(*low), std::abs(*high)) && *high > *low;
}

json orders_data(const Trajectory& run) {
  constexpr std::size_t kMost = 300;
  if (!changes_speed(run)) return nullptr;
  const OrderTrack track = order_track(run, kMost);
  if (track.t.size() < 2) return nullptr;
  json amplitude = json::array(), phase = json::array();
  for (std::size_t k = 0; k < OrderTrack::kOrders; ++k) {
    std::vector<double> sizes, angles;
    for (const auto& vectors : track.probe) {
      angles.push_back(phase_degrees(vectors[k], angles.empty() ? 0.0 : angles.back()));
      sizes.push_back(std::abs(vectors[k]));
    }
    amplitude.push_back(rounded_list(sizes, kMicronsOfRunUp, 5));
    phase.push_back(rounded_list(angles, 1.0, 5));
  }
  std::vector<double> speed = track.speed;
  for (double& s : speed) s = std::abs(s);
  return {{"t", rounded_list(track.t, 1.0, 7)},
          {"speed", rounded_list(speed, kRpm)},
          {"amplitude", amplitude},
          {"phase", phase}};
}

json cascade_data(const Trajectory& run) {
  constexpr std::size_t kSpeeds = 36, kFrequencies = 241;
  constexpr double kOrders = 3.2;  // up to this multiple of the fastest spin
  if (!changes_speed(run)) return nullptr;
  double fastest = 0.0;
  for (const double speed : run.column("spin_speed")) fastest = std::max(fastest, std::abs(speed));
  const double highest = kOrders * fastest * kHz;
  const Cascade found = cascade(run, kSpeeds, kFrequencies, highest);
  std::vector<double> cells = found.amplitude;
  for (double& a : cells) a *= kMicronsOfRunUp;
  if (found.t.size() < 2) return nullptr;
  json all = levels_data(cells);
  if (all.is_null()) return nullptr;
  all["t"] = rounded_list(found.t, 1.0, 7);
  all["speed"] = rounded_list(found.speed, kRpm);
  all["f"] = {rounded(-highest), rounded(highest)};
  all["columns"] = found.frequency.size();
  return all;
}

}  // namespace rotorub
