// Rows of [magnetic_bearing], of the tables below it and of [magnetic_control]. The cross-checks
// are in magnetic_checks.cc.

#include "native_model/scene/schema.h"

namespace rotorub::scene {
namespace {

Table magnetic_bearing() {
  return {
      "magnetic_bearing",
      "A magnetic bearing; r is the rotor's deflection, i the control current. For several use "
      "[[magnetic_bearing]], each followed by its own tables.",
      "none",
      [](Scene& scene) -> void* { return &scene.magnetic_bearings.emplace_back(); },
      {word<&MagneticBearing::kind>("kind", {"linear", "electromagnet"}, kStandard,
                                    "`linear`: F = `negative_stiffness` r + `force_per_current` i; "
                                    "`electromagnet`: two magnets on each of x and y, F = k_m "
                                    "[((i_0 + i)/(s_0 - r))^2 - ((i_0 - i)/(s_0 + r))^2]"),
       key<&MagneticBearing::negative_stiffness>("negative_stiffness", kStiffness, ">= 0",
                                                 kRequired, "k_s", {"linear"}),
       key<&MagneticBearing::force_constant>("force_constant", kMagnetConstant, "> 0", kRequired,
                                             "k_m", {"electromagnet"}),
       key<&MagneticBearing::bias_current>("bias_current", kCurrent, "> 0", kRequired,
                                           "i_0, in both magnets", {"electromagnet"}),
       key<&MagneticBearing::air_gap>("air_gap", kLength, "> 0", kRequired,
                                      "s_0, gap of each magnet at r = 0", {"electromagnet"}),
       key<&MagneticBearing::shape>("shape", kPure, "", "all 1", "mode values at the station")
           .in(Form::kModal),
       key<&MagneticBearing::station>("station", kLength, ">= 0", kRequired, "axial position")
           .or_called("z")
           .in(Form::kGeometry),
       key<&MagneticBearing::sensor_shape>("sensor_shape", kPure, "", "`shape`",
                                           "mode values at the sensor")
           .in(Form::kModal),
       key<&MagneticBearing::sensor_station>("sensor_station", kLength, ">= 0", "`station`",
                                             "of the sensor")
           .in(Form::kGeometry)}};
}

Table bearing_control() {
  return {
      "magnetic_bearing.control",
      "Feedback of the deflection r at the sensor, on x and y. A bearing that is off has neither "
      "current nor negative stiffness.",
      "i = 0",
      [](Scene& scene) -> void* { return &scene.magnetic_bearings.back().control.emplace(); },
      {word<&BearingControl::form>(
           "kind", {"pid", "transfer_function", "state_space", "shared"}, kStandard,
           "`pid`: i = -(P r + I times the integral of r + D r'); `transfer_function`: i = -H(z) "
           "r; `state_space`: x_{k+1} = A x_k + B r, i = -(C x_k + D r), per axis; `shared`: by "
           "[magnetic_control]"),
       key<&BearingControl::force_per_current>("force_per_current", kForcePerCurrent, "> 0",
                                               "required for `linear`",
                                               "k_i, for a `linear` bearing"),
       key<&BearingControl::proportional>("proportional", kCurrentPerLength, ">= 0",
                                          "0; required for `pid`",
                                          "P; else a spring for the shaft's modes"),
       key<&BearingControl::integral>("integral", kCurrentPerLengthTime, ">= 0", kStandard,
                                      "I, with anti-windup; needs `proportional`", {"pid"}),
       key<&BearingControl::derivative>("derivative", kCurrentPerVelocity, ">= 0", kStandard, "D",
                                        {"pid"}),
       key<&BearingControl::derivative_lag>("derivative_lag", kTime, ">= 0", kStandard,
                                            "T of the derivative's filter, D s/(1 + T s)", {"pid"}),
       key<&BearingControl::sample_time>(
           "sample_time", kTime, ">= 0", "0; required except for `pid`",
           "sampling interval; 0: continuous", {"pid", "transfer_function", "state_space"}),
       key<&BearingControl::delay>(
           "delay", kTime, ">= 0", kStandard,
           "from sample to current, a multiple of `sample_time`; i = 0 before",
           {"pid", "transfer_function", "state_space"}),
       key<&BearingControl::numerator>("numerator", kCurrentPerLength, "", kRequired,
                                       "b_0, b_1, ... of H, by powers of 1/z",
                                       {"transfer_function"}),
       key<&BearingControl::denominator>("denominator", kPure, "", kRequired,
                                         "a_0, a_1, ... of H; a_0 is not 0", {"transfer_function"}),
       key<&BearingControl::matrices, &ControlMatrices::state>(
           "state_matrix", kPure, "", kRequired, "A, row by row, n times n", {"state_space"}),
       key<&BearingControl::matrices, &ControlMatrices::input>("input_matrix", kPure, "", kRequired,
                                                               "B, n values", {"state_space"}),
       key<&BearingControl::matrices, &ControlMatrices::output>(
           "output_matrix", kPure, "", kRequired, "C, n values", {"state_space"}),
       key<&BearingControl::matrices, &ControlMatrices::feedthrough>(
           "feedthrough", kCurrentPerLength, "", kRequired, "[D]", {"state_space"}),
       key<&BearingControl::current_limit>("current_limit", kCurrent, "> 0",
                                           "none; electromagnet: `bias_current`, the maximum",
                                           "largest current on each axis"),
       key<&BearingControl::works_from>("on", kTime, ">= 0", kStandard, "switch-on time"),
       key<&BearingControl::fails_at>("fails_at", kTime, ">= 0", "never", "switch-off time"),
       key<&BearingControl::returns_at>("returns_at", kTime, ">= 0", "never",
                                        "second switch-on time, after `fails_at`")}};
}

Table magnetic_control() {
  return {"magnetic_control",
          "One sampled law for all bearings of kind `shared`, from the p deflections r to the p "
          "currents i: x, y of each bearing in file order. Matrices: row by row.",
          "each bearing has its own law",
          [](Scene& scene) -> void* { return &scene.magnetic_control.emplace(); },
          {word<&SharedControl::kind>(
               "kind", {"matrices", "library"}, kStandard,
               "`matrices`: x_{k+1} = A x_k + B r, i = -(C x_k + D r); `library`: your own"),
           key<&SharedControl::sample_time>("sample_time", kTime, "> 0", kRequired,
                                            "sampling interval"),
           key<&SharedControl::delay>("delay", kTime, ">= 0", kStandard,
                                      "as in [magnetic_bearing.control]"),
           key<&SharedControl::matrices, &ControlMatrices::state>(
               "state_matrix", kPure, "", kRequired, "A, n times n", {"matrices"}),
           key<&SharedControl::matrices, &ControlMatrices::input>(
               "input_matrix", kPure, "", kRequired, "B, n times p", {"matrices"}),
           key<&SharedControl::matrices, &ControlMatrices::output>(
               "output_matrix", kPure, "", kRequired, "C, p times n", {"matrices"}),
           key<&SharedControl::matrices, &ControlMatrices::feedthrough>(
               "feedthrough", kCurrentPerLength, "", kRequired, "D, p times p", {"matrices"}),
           key<&SharedControl::library>(
               "library", kPure, "", kRequired,
               "shared library or Python file, beside the scene or absolute", {"library"})}};
}

Table magnetic_config() {
  return {"magnetic_control.config",
          "Any keys for your own law: numbers and texts.",
          "nothing",
          [](Scene& scene) -> void* { return &scene.magnetic_control->config; },
          {},
          {"library"},
          true};
}

Table amplifier() {
  return {"magnetic_bearing.amplifier",
          "The coils' current i follows the commanded current c: di/dt = `bandwidth` (c - i), "
          "within the voltage limit. Needs [magnetic_bearing.control].",
          "i = c",
          [](Scene& scene) -> void* { return &scene.magnetic_bearings.back().amplifier.emplace(); },
          {key<&Amplifier::bandwidth>("bandwidth", kSpin, "> 0", kRequired,
                                      "frequency at which i lags by 45 degrees"),
           key<&Amplifier::voltage_limit>(
               "voltage_limit", kVoltage, "> 0", "none",
               "limit on `inductance` di/dt + `resistance` i; needs `inductance`"),
           key<&Amplifier::inductance>("inductance", kInductance, "> 0", "none",
                                       "inductance of an axis"),
           key<&Amplifier::resistance>("resistance", kResistance, ">= 0", kStandard,
                                       "resistance of an axis")}};
}

}  // namespace

std::vector<Table> magnetic_tables() {
  Table magnets = magnetic_bearing();
  magnets.or_list = true;
  return {std::move(magnets), bearing_control(), amplifier(), magnetic_control(),
          magnetic_config()};
}

}  // namespace rotorub::scene
