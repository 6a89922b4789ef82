// The rows of the controller: the law, its sensors, its trigger, what a library is given.

#include <utility>

#include "native_model/scene/schema.h"

namespace rotorub::scene {
namespace {

Table controller() {
  return {
      "controller",
      "What commands the ring. Needs [stator]; all but `passive` and `library` need [contact].",
      "no command",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().controller.emplace(); },
      {word<&Controller::kind>(
           "kind",
           {"passive", "sliding", "cross_coupled", "two_phase", "pd", "lqr", "lqg", "library"},
           kRequired,
           "an extra spring and damper emulated by the actuator; sliding mode with a boundary "
           "layer, which brings the ring to the rotor; k(Omega) across the ring's velocity; the "
           "second, and the third from the first touch on; a spring and a damper that bring the "
           "ring to the rotor; linear quadratic feedback that keeps the ring about the rotor, of "
           "the state or of its estimate; one of your own"),
       key<&Controller::on>("on", kTime, "", kStandard, "switched on, or its trigger armed"),
       key<&Controller::sample_time>(
           "sample_time", kTime, ">= 0", kStandard,
           "held between samples; 0: continuous, for a law without memory"),
       key<&Controller::library>(
           "library", kPure, "", kRequired,
           "shared library, beside the scene's file or absolute (C header: rotorub/controller.h)",
           {"library"}),
       key<&Controller::bandwidth>("bandwidth", kRate, "> 0", kStandard,
                                   "psi, decay of the tracking error", {"sliding", "two_phase"}),
       key<&Controller::boundary_layer>("boundary_layer", kVelocity, "> 0", kStandard,
                                        "phi, half its width", {"sliding", "two_phase"}),
       word<&Controller::layer>("layer", {"constant", "adaptive"}, kStandard,
                                "phi stays `boundary_layer`, or goes from there to k / psi, (27)",
                                {"sliding", "two_phase"}),
       key<&Controller::switching_gain>("switching_gain", kAcceleration, ">= 0", kStandard,
                                        "k, bound on the unknown acceleration",
                                        {"sliding", "two_phase"}),
       key<&Controller::gap_time>("gap_time", kTime, "> 0", kStandard,
                                  "in which the gap reference falls to 0",
                                  {"sliding", "two_phase", "pd"}),
       key<&Controller::preload>("preload", kForce, ">= 0", kStandard,
                                 "normal force of the lasting contact, once the gap is closed",
                                 {"sliding", "two_phase", "pd"}),
       key<&Controller::mass_error>("mass_error", kPure, "> -1", kStandard,
                                    "by which share the law takes the ring for heavier than it is",
                                    {"sliding", "two_phase", "library"}),
       key<&Controller::stiffness>("stiffness", kStiffness, ">= 0", kStandard,
                                   "of the emulated spring; of the tracking error",
                                   {"passive", "pd"}),
       key<&Controller::damping>(
           "damping", kDamping, ">= 0", kStandard,
           "of the emulated damper; of the tracking error; of the ring beside the feedback",
           {"passive", "pd", "cross_coupled", "two_phase"}),
       key<&Controller::feedback>("feedback", kDamping, ">= 0", kRequired,
                                  "k, one value or one for each speed",
                                  {"cross_coupled", "two_phase"}),
       key<&Controller::feedback_speed>("feedback_speed", kSpin, ">= 0", "one value at every speed",
                                        "of those values, ascending; between them linear",
                                        {"cross_coupled", "two_phase"}),
       key<&Controller::handover_time>("handover_time", kTime, "> 0", kStandard,
                                       "in which the force of the first law fades out",
                                       {"two_phase"}),
       key<&Controller::filter_time>(
           "filter_time", kTime, ">= 0", "one turn of the spin",
           "of the mean of the feed-forward, in the frame of the whirl; sampled laws only",
           {"sliding", "two_phase"}),
       key<&Controller::tracking_damping>(
           "tracking_damping", kDamping, ">= 0", "the ring's critical one",
           "of the ring's velocity about its mean there; sampled laws only",
           {"sliding", "two_phase"}),
       key<&Controller::allowed_error>("allowed_error", kLength, "> 0", kStandard,
                                       "e_0, of the rotor from the ring's centre", {"lqr", "lqg"}),
       key<&Controller::allowed_travel>("allowed_travel", kLength, "> 0", kStandard,
                                        "s_0, of the ring", {"lqr", "lqg"}),
       key<&Controller::allowed_force>("allowed_force", kForce, "> 0", kStandard, "u_0",
                                       {"lqr", "lqg"}),
       key<&Controller::disturbance>(
           "disturbance", kForce, "> 0", kStandard,
           "standard deviation of forces on rotor and ring at the contact", {"lqg"}),
       key<&Controller::measurement_error>("measurement_error", kLength, "> 0", kStandard,
                                           "standard deviation of the measured positions",
                                           {"lqg"})}};
}

Controller& controller_of(Scene& scene) {
  return scene.auxiliary.back().controller ? *scene.auxiliary.back().controller
                                           : scene.auxiliary.back().controller.emplace();
}

Table sensors() {
  return {"controller.sensors",
          "What a sampled controller is shown of the plant. Needs `sample_time`.",
          "the truth",
          [](Scene& scene) -> void* { return &controller_of(scene).sensors; },
          {key<&Sensors::rotor>("rotor", kPure, "", kStandard, "the rotor is measured"),
           key<&Sensors::stator>("stator", kPure, "", kStandard, "the ring is measured"),
           key<&Sensors::spin>("spin", kPure, "", kStandard,
                               "angle and speed of the spin are measured"),
           key<&Sensors::current>("current", kPure, "", kStandard,
                                  "the magnets' currents are measured"),
           word<&Sensors::velocity>(
               "velocity", {"measured", "difference", "none"}, kStandard,
               "of rotor and ring: measured, from the positions of two samples, or not at all"),
           key<&Sensors::delay>("delay", kTime, ">= 0", kStandard,
                                "between the measurement and the command; whole samples"),
           key<&Sensors::position_resolution>("position_resolution", kLength, ">= 0", kStandard,
                                              "0: none"),
           key<&Sensors::velocity_resolution>("velocity_resolution", kVelocity, ">= 0", kStandard,
                                              "0: none"),
           key<&Sensors::current_resolution>("current_resolution", kCurrent, ">= 0", kStandard,
                                             "0: none"),
           key<&Sensors::position_noise>("position_noise", kLength, ">= 0", kStandard,
                                         "standard deviation"),
           key<&Sensors::velocity_noise>("velocity_noise", kVelocity, ">= 0", kStandard,
                                         "standard deviation"),
           key<&Sensors::current_noise>("current_noise", kCurrent, ">= 0", kStandard,
                                        "standard deviation"),
           key<&Sensors::seed>("seed", kPure, ">= 0", kStandard, "of the noise")}};
}

Table trigger() {
  return {
      "controller.trigger",
      "Switches a sampled controller on at the first of these, once `on` has come. Needs "
      "[contact].",
      "it is switched on at `on`",
      [](Scene& scene) -> void* { return &controller_of(scene).trigger.emplace(); },
      {key<&Trigger::gap>("gap", kLength, "> 0", "none", "measured, at which it is switched on"),
       key<&Trigger::time_to_touch>("time_to_touch", kTime, "> 0", "none",
                                    "predicted, gap over closing rate, at which it is switched on"),
       key<&Trigger::touch>("touch", kPure, "", kStandard, "rotor and ring have touched")}};
}

Table config() {
  return {"controller.config",
          "What a controller of your own is given: any keys, each a number or a text.",
          "nothing",
          [](Scene& scene) -> void* { return &controller_of(scene).config; },
          {},
          {"library"},
          [](void* object, ConfigEntry entry) {
            static_cast<std::vector<ConfigEntry>*>(object)->push_back(std::move(entry));
          }};
}

}  // namespace

std::vector<Table> control_tables() { return {controller(), sensors(), trigger(), config()}; }

}  // namespace rotorub::scene
