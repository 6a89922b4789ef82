#include "compare/report/trade.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/base/units.h"
#include "compare/report/plot_points.h"

namespace rotorub {

using nlohmann::json;

Trade trade_of(const Side& native) {
  const Trajectory& t = native.trajectory;
  Trade trade;
  trade.contact_force = native.metrics.mean_force;
  const auto &time = t.column("t"), &x = t.column("rotor_x"), &y = t.column("rotor_y");
  const double from = (1.0 - kSettledShare) * t.end;
  const bool driven = t.has("control_x");
  double square = 0.0;
  std::size_t rows = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (time[i] < from) continue;
    trade.orbit = std::max(trade.orbit, std::hypot(x[i], y[i]));
    if (driven)
      square += std::pow(t.column("control_x")[i], 2) + std::pow(t.column("control_y")[i], 2);
    ++rows;
  }
  if (rows > 0) trade.actuator_force = std::sqrt(square / static_cast<double>(rows));
  return trade;
}

json trade_data(const std::vector<const SceneComparison*>& scenes) {
  if (scenes.size() < 2) return nullptr;
  return list_of(scenes, [](const SceneComparison* scene) -> json {
    const Trade trade = trade_of(scene->native);
    return {{"name", scene->scene.name},
            {"orbit", rounded(kMilli * trade.orbit, 5)},
            {"contact", rounded(trade.contact_force, 5)},
            {"actuator", rounded(trade.actuator_force, 5)}};
  });
}

}  // namespace rotorub
