// Rows of [magnetic_bearing], of the tables below it and of [magnetic_control]. The cross-checks
// are in magnetic_checks.cc.

#include "native_model/scene/schema.h"

namespace rotorub::scene {
namespace {

Table magnetic_bearing() {
  return {"magnetic_bearing",
          "Adds the force of its magnets at its station, and what its `control` does; its "
          "excitation is a [[force]] at the same station. Or several of them, each "
          "[[magnetic_bearing]] with its own [magnetic_bearing.control] and "
          "[magnetic_bearing.amplifier].",
          "none",
          [](Scene& scene) -> void* { return &scene.magnetic_bearings.emplace_back(); },
          {word<&MagneticBearing::kind>(
               "kind", {"linear", "electromagnet"}, kStandard,
               "the force `negative_stiffness` r + `force_per_current` i, r the deflection at its "
               "station, i the current of its control; two magnets that pull against each other "
               "on each of x and y, `force_constant` [((`bias_current` + i)/(`air_gap` - r))^2 - "
               "((`bias_current` - i)/(`air_gap` + r))^2]"),
           key<&MagneticBearing::negative_stiffness>("negative_stiffness", kStiffness, ">= 0",
                                                     kRequired, "its size, k_s", {"linear"}),
           key<&MagneticBearing::force_constant>("force_constant", kMagnetConstant, "> 0",
                                                 kRequired, "k_m", {"electromagnet"}),
           key<&MagneticBearing::bias_current>("bias_current", kCurrent, "> 0", kRequired,
                                               "i_0, in both magnets", {"electromagnet"}),
           key<&MagneticBearing::air_gap>(
               "air_gap", kLength, "> 0", kRequired,
               "s_0, of each magnet at r = 0; the cores do not stop the rotor, and beyond 99 % of "
               "the gap the magnets pull as at 99 %",
               {"electromagnet"}),
           key<&MagneticBearing::shape>("shape", kPure, "", "all 1",
                                        "value of each bending mode at the station")
               .in(Form::kModal),
           key<&MagneticBearing::station>("station", kLength, ">= 0", kRequired,
                                          "place along the shaft")
               .or_called("z")
               .in(Form::kGeometry),
           key<&MagneticBearing::sensor_shape>("sensor_shape", kPure, "", "`shape`",
                                               "the same where `control` sees the deflection")
               .in(Form::kModal),
           key<&MagneticBearing::sensor_station>("sensor_station", kLength, ">= 0", "`station`",
                                                 "where `control` sees the deflection")
               .in(Form::kGeometry)}};
}

Table bearing_control() {
  return {"magnetic_bearing.control",
          "The bearing's own feedback, on each of x and y by the deflection r at its sensor: the "
          "current i = -(`proportional` r + `integral` times the integral of r + `derivative` r'), "
          "within the limit (A magnetic bearing that holds the rotor). Needs [magnetic_bearing].",
          "the bearing holds nothing",
          [](Scene& scene) -> void* {
            if (scene.magnetic_bearings.empty()) scene.magnetic_bearings.emplace_back();
            return &scene.magnetic_bearings.back().control.emplace();
          },
          {word<&BearingControl::form>(
               "kind", {"pid", "transfer_function", "state_space", "shared"}, kStandard,
               "that law, continuous or sampled; i = -H(z) r, sampled; the same by matrices, x' = "
               "A x + "
               "B r, i = -(C x + D r), of each axis; what [magnetic_control] asks for"),
           key<&BearingControl::force_per_current>(
               "force_per_current", kForcePerCurrent, "> 0", "that of an electromagnet",
               "k_i, of a bearing of kind `linear`, which needs it"),
           key<&BearingControl::proportional>(
               "proportional", kCurrentPerLength, ">= 0", "0; of `pid` required",
               "P; of the other kinds no law: the modes of a shaft are made with its spring"),
           key<&BearingControl::integral>(
               "integral", kCurrentPerLengthTime, ">= 0", kStandard,
               "I; at the limit it takes back what is cut off; needs `proportional`", {"pid"}),
           key<&BearingControl::derivative>("derivative", kCurrentPerVelocity, ">= 0", kStandard,
                                            "D", {"pid"}),
           key<&BearingControl::derivative_lag>(
               "derivative_lag", kTime, ">= 0", kStandard,
               "T, of the derivative's filter: D s/(1 + T s); 0: none", {"pid"}),
           key<&BearingControl::sample_time>(
               "sample_time", kTime, ">= 0", "0; of other kinds than `pid` required",
               "the current asked for is held between samples; 0: continuous",
               {"pid", "transfer_function", "state_space"}),
           key<&BearingControl::delay>(
               "delay", kTime, ">= 0", kStandard,
               "time from a sample to its current, a whole number of samples; at the start, and "
               "whenever the bearing is switched on, the current is 0 until it has passed",
               {"pid", "transfer_function", "state_space"}),
           key<&BearingControl::numerator>("numerator", kCurrentPerLength, "", kRequired,
                                           "of H: of powers of 1/z, from the 0th",
                                           {"transfer_function"}),
           key<&BearingControl::denominator>("denominator", kPure, "", kRequired,
                                             "the same; its first is not 0", {"transfer_function"}),
           key<&BearingControl::matrices, &ControlMatrices::state>(
               "state_matrix", kPure, "", kRequired, "A, row by row, n times n", {"state_space"}),
           key<&BearingControl::matrices, &ControlMatrices::input>(
               "input_matrix", kPure, "", kRequired, "B, n values", {"state_space"}),
           key<&BearingControl::matrices, &ControlMatrices::output>(
               "output_matrix", kPure, "", kRequired, "C, n values", {"state_space"}),
           key<&BearingControl::matrices, &ControlMatrices::feedthrough>(
               "feedthrough", kCurrentPerLength, "", kRequired, "[D]", {"state_space"}),
           key<&BearingControl::current_limit>("current_limit", kCurrent, "> 0",
                                               "none; of an electromagnet `bias_current`, the most",
                                               "of the current's size on each axis"),
           key<&BearingControl::works_from>("on", kTime, ">= 0", kStandard,
                                            "switches the bearing on; before this time it has "
                                            "neither current nor negative stiffness"),
           key<&BearingControl::fails_at>("fails_at", kTime, ">= 0", "never",
                                          "switches the bearing off; from this time on it has "
                                          "neither current nor negative stiffness"),
           key<&BearingControl::returns_at>(
               "returns_at", kTime, ">= 0", "never",
               "switches the bearing on again, for the rest of the run; after `fails_at`")}};
}

Table magnetic_control() {
  return {"magnetic_control",
          "One sampled law for all bearings whose control is of kind `shared`, p = two ports of "
          "each in the order of the file, x before y: the currents i of the deflections r at their "
          "sensors. Matrices stand row by row.",
          "each for itself",
          [](Scene& scene) -> void* { return &scene.magnetic_control.emplace(); },
          {word<&SharedControl::kind>("kind", {"matrices", "library"}, kStandard,
                                      "i = -(C x + D r), x' = A x + B r; one of your own"),
           key<&SharedControl::sample_time>("sample_time", kTime, "> 0", kRequired,
                                            "the currents asked for are held between samples"),
           key<&SharedControl::delay>(
               "delay", kTime, ">= 0", kStandard,
               "time from a sample to its currents, a whole number of samples; at the start, and "
               "whenever a bearing is switched on, its current is 0 until it has passed"),
           key<&SharedControl::matrices, &ControlMatrices::state>(
               "state_matrix", kPure, "", kRequired, "A, n times n", {"matrices"}),
           key<&SharedControl::matrices, &ControlMatrices::input>(
               "input_matrix", kPure, "", kRequired, "B, n times p", {"matrices"}),
           key<&SharedControl::matrices, &ControlMatrices::output>(
               "output_matrix", kPure, "", kRequired, "C, p times n", {"matrices"}),
           key<&SharedControl::matrices, &ControlMatrices::feedthrough>(
               "feedthrough", kCurrentPerLength, "", kRequired, "D, p times p", {"matrices"}),
           key<&SharedControl::library>("library", kPure, "", kRequired,
                                        "shared library, beside the scene's file or absolute (C "
                                        "header: rotorub/controller.h)",
                                        {"library"})}};
}

Table magnetic_config() {
  return {"magnetic_control.config",
          "What a law of your own for the magnetic bearings is given: any keys, each a number or a "
          "text.",
          "nothing",
          [](Scene& scene) -> void* { return &scene.magnetic_control->config; },
          {},
          {"library"},
          [](void* object, ConfigEntry entry) {
            static_cast<std::vector<ConfigEntry>*>(object)->push_back(std::move(entry));
          }};
}

Table amplifier() {
  return {"magnetic_bearing.amplifier",
          "What drives the coils of an axis: its current i follows the one c that the control asks "
          "for, di/dt = `bandwidth` (c - i), within the voltage. Needs [magnetic_bearing.control].",
          "the current is at once what is asked for",
          [](Scene& scene) -> void* {
            if (scene.magnetic_bearings.empty()) scene.magnetic_bearings.emplace_back();
            return &scene.magnetic_bearings.back().amplifier.emplace();
          },
          {key<&Amplifier::bandwidth>("bandwidth", kSpin, "> 0", kRequired,
                                      "at which the current lags by 45 degrees"),
           key<&Amplifier::voltage_limit>(
               "voltage_limit", kVoltage, "> 0", "none",
               "of the size of u: `inductance` di/dt = u - `resistance` i; needs `inductance`"),
           key<&Amplifier::inductance>("inductance", kInductance, "> 0", "none",
                                       "of the coils of an axis; needs `voltage_limit`"),
           key<&Amplifier::resistance>("resistance", kResistance, ">= 0", kStandard,
                                       "of the coils of an axis; needs `voltage_limit`")}};
}

}  // namespace

std::vector<Table> magnetic_tables() {
  Table magnets = magnetic_bearing();
  magnets.or_list = true;
  return {std::move(magnets), bearing_control(), amplifier(), magnetic_control(),
          magnetic_config()};
}

}  // namespace rotorub::scene
