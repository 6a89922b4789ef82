// [actuator] of an auxiliary bearing: rows and cross-checks.

#include <algorithm>

#include "native_model/scene/reading.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

Table actuator() {
  return {
      "actuator",
      "Moves the ring along the axes (1, 1)/sqrt 2 and (-1, 1)/sqrt 2; s and i are an axis' "
      "position and current. Needs [stator].",
      "an ideal, unlimited force",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().actuator.emplace(); },
      {word<&Actuator::kind>(
           "kind", {"ideal", "electromagnet", "table"}, kStandard,
           "`ideal`: the commanded force; `electromagnet`: F(s, i) = k_m [((i_0 + i)/(s_0 - s))^2 "
           "- ((i_0 - i)/(s_0 + s))^2] - `stiffness` s; `table`: F(s, i) by a bicubic spline"),
       key<&Actuator::force_limit>("force_limit", kForce, "> 0", "none",
                                   "largest force on each axis", {"ideal"}),
       key<&Actuator::force_constant>("force_constant", kMagnetConstant, "> 0", kRequired, "k_m",
                                      {"electromagnet"}),
       key<&Actuator::bias_current>("bias_current", kCurrent, "> 0", kRequired,
                                    "i_0, in both magnets", {"electromagnet"}),
       key<&Actuator::air_gap>("air_gap", kLength, "> 0", kRequired,
                               "s_0, gap of each magnet at s = 0", {"electromagnet"}),
       key<&Actuator::stiffness>("stiffness", kStiffness, ">= 0", kStandard,
                                 "spring of the actuator", {"electromagnet"}),
       key<&Actuator::table_position>("table_position", kLength, "", kRequired,
                                      "values of s, ascending, four or more", {"table"}),
       key<&Actuator::table_current>("table_current", kCurrent, "", kRequired,
                                     "values of i, ascending through 0, four or more", {"table"}),
       key<&Actuator::table_force>(
           "table_force", kForce, "", kRequired,
           "F for all currents, position after position, rising with the current", {"table"}),
       key<&Actuator::current_limit>("current_limit", kCurrent, "> 0",
                                     "`bias_current`, or the table's range",
                                     "largest commanded current", {"electromagnet", "table"}),
       key<&Actuator::coil_lag>("coil_lag", kTime, ">= 0", kStandard,
                                "`coil_lag` di/dt = command - i", {"electromagnet", "table"}),
       key<&Actuator::current_rate_limit>("current_rate_limit", kCurrentRate, "> 0", "none",
                                          "limit on di/dt; needs `coil_lag`",
                                          {"electromagnet", "table"}),
       key<&Actuator::voltage_limit>(
           "voltage_limit", kVoltage, "> 0", "none",
           "limit on `inductance` di/dt + `resistance` i; needs `coil_lag`, `inductance`",
           {"electromagnet", "table"}),
       key<&Actuator::inductance>("inductance", kInductance, "> 0", "none", "inductance of an axis",
                                  {"electromagnet", "table"}),
       key<&Actuator::resistance>("resistance", kResistance, ">= 0", kStandard,
                                  "resistance of an axis", {"electromagnet", "table"})}};
}

void check_force_table(const Reading& check, const Actuator& actuator) {
  constexpr std::size_t kLeast = 4;  // needed for a cubic
  const std::vector<double>&position = actuator.table_position, &current = actuator.table_current;
  bool sound = true;
  const auto refuse = [&](const char* key, const std::string& reason) {
    check.fail(key, reason);
    sound = false;
  };
  for (const auto& [key, list] : {std::pair("actuator.table_position", &position),
                                  std::pair("actuator.table_current", &current)}) {
    if (!check.given(key) || !check.sound({key})) {
      sound = false;
    } else if (list->size() < kLeast) {
      refuse(key, "expected four values or more");
    } else if (!check.ascending(key, *list)) {
      sound = false;
    }
  }
  if (sound && !(current.front() < 0.0 && current.back() > 0.0)) {
    refuse("actuator.table_current", "must reach from below 0 to above 0");
  }
  if (!sound || !check.given("actuator.table_force") || !check.sound({"actuator.table_force"})) {
    return;
  }
  const std::size_t expected = position.size() * current.size(), got = actuator.table_force.size();
  if (got != expected) {
    return check.fail("actuator.table_force",
                      "expected " + std::to_string(expected) +
                          " values, one for each pair of a position and a current, got " +
                          std::to_string(got));
  }
  const double most = std::min(-current.front(), current.back());
  if (check.sound({"actuator.current_limit"}) && actuator.current_limit > most) {
    check.fail("actuator.current_limit",
               "must be within the table, at most " + number_text(most) + " A");
  }
}

void check_actuator(const Reading& check, const Actuator& actuator) {
  if (actuator.kind == ActuatorKind::kIdeal) return;
  if (actuator.kind == ActuatorKind::kTable) check_force_table(check, actuator);
  if (actuator.kind == ActuatorKind::kElectromagnet &&
      check.sound({"actuator.bias_current", "actuator.current_limit"}) &&
      actuator.current_limit > actuator.bias_current) {
    check.fail("actuator.current_limit",
               "must be at most actuator.bias_current = " + number_text(actuator.bias_current) +
                   " A: beyond it a magnet's current would reverse");
  }
  for (const char* key : {"actuator.current_rate_limit", "actuator.voltage_limit"}) {
    if (check.given(key) && actuator.coil_lag == 0.0 && check.sound({"actuator.coil_lag"})) {
      check.fail(key, "needs actuator.coil_lag: without it the current follows at once");
    }
  }
  check.voltage("actuator");
}

}  // namespace

std::vector<Table> actuator_tables() { return {actuator()}; }

void check_actuator(const Reading& check) {
  if (check.bearing().actuator) check_actuator(check, *check.bearing().actuator);
}

}  // namespace rotorub::scene
