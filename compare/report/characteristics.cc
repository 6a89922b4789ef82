#include "compare/report/characteristics.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "compare/base/units.h"
#include "compare/report/rounded.h"
#include "native_model/bearing/drive.h"
#include "native_model/system/model.h"

namespace rotorub {
namespace {

using nlohmann::json;

constexpr int kPoints = 61;

// m: how far from the middle the curves go.
double shown_travel(const scene::Actuator& a) {
  if (a.kind == scene::ActuatorKind::kTable)
    return std::min(-a.table_position.front(), a.table_position.back());
  return 0.4 * a.air_gap;
}

}  // namespace

json actuator_curves(const scene::Scene& scene, std::size_t bearing) {
  json curves = json::array();
  const Model model = make_model(scene);
  const auto& magnets = model.auxiliary[bearing].magnets;
  if (!magnets) return curves;
  const double travel = shown_travel(*scene.auxiliary[bearing].actuator);
  for (const double part : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    json x = json::array(), y = json::array();
    for (int k = 0; k < kPoints; ++k) {
      const double i = magnets->current_limit * (2.0 * k / (kPoints - 1) - 1.0);
      x.push_back(rounded(i, 6));
      y.push_back(rounded(magnets->law->force(part * travel, i), 6));
    }
    curves.push_back(
        {{"name", fmt::format("s = {:.3g} mm", kMilli * part * travel)}, {"x", x}, {"y", y}});
  }
  return curves;
}

json motor_curve(const scene::Scene& scene, double from, double to) {
  if (!scene.drive) return nullptr;
  const Drive drive(*scene.drive, scene.rotor.speed);
  if (drive.follows() || drive.kind() == scene::DriveKind::kFree) return nullptr;
  json x = json::array(), y = json::array();
  for (int k = 0; k < kPoints; ++k) {
    const double speed = from + (to - from) * k / (kPoints - 1);
    x.push_back(rounded(kRpm * speed, 6));
    y.push_back(rounded(drive.torque(speed), 6));
  }
  return {{"x", x}, {"y", y}};
}

}  // namespace rotorub
