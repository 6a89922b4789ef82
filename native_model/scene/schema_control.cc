// The rows of the controller: the law, its sensors, its trigger, what a library is given.

#include <utility>

#include "native_model/scene/schema.h"

namespace rotorub::scene {
namespace {

Table controller() {
  return {
      "controller",
      false,
      Form::kEither,
      "What commands the ring. Needs [stator]; all but `passive` and `library` need [contact].",
      "no command",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().controller.emplace(); },
      {word<&Controller::kind>(
           "kind",
           {"passive", "sliding", "cross_coupled", "two_phase", "pd", "lqr", "lqg", "library"},
           "an extra spring and damper emulated by the actuator; sliding mode with a boundary "
           "layer, "
           "which brings the ring to the rotor; k(Omega) across the ring's velocity; the second, "
           "and the "
           "third from the first touch on; a spring and a damper that bring the ring to the rotor; "
           "linear "
           "quadratic feedback that keeps the ring about the rotor, of the state or of its "
           "estimate; one "
           "of your own"),
       key<&Controller::on>("on", kTime, "switched on, or its trigger armed").optional(),
       key<&Controller::sample_time>(
           "sample_time", kTime, "held between samples; 0: continuous, for a law without memory")
           .at_least(0)
           .optional(),
       key<&Controller::library>("library", kPure,
                                 "shared library, beside the scene's file or absolute (C header: "
                                 "rotorub/controller.h)")
           .of({"library"}),
       key<&Controller::bandwidth>("bandwidth", kRate, "psi, decay of the tracking error")
           .above(0)
           .of({"sliding", "two_phase"})
           .optional(),
       key<&Controller::boundary_layer>("boundary_layer", kVelocity, "phi, half its width")
           .above(0)
           .of({"sliding", "two_phase"})
           .optional(),
       word<&Controller::layer>("layer", {"constant", "adaptive"},
                                "phi stays `boundary_layer`, or goes from there to k / psi, (27)")
           .of({"sliding", "two_phase"})
           .optional(),
       key<&Controller::switching_gain>("switching_gain", kAcceleration,
                                        "k, bound on the unknown acceleration")
           .at_least(0)
           .of({"sliding", "two_phase"})
           .optional(),
       key<&Controller::gap_time>("gap_time", kTime, "in which the gap reference falls to 0")
           .above(0)
           .of({"sliding", "two_phase", "pd"})
           .optional(),
       key<&Controller::preload>("preload", kForce,
                                 "normal force of the lasting contact, once the gap is closed")
           .at_least(0)
           .of({"sliding", "two_phase", "pd"})
           .optional(),
       key<&Controller::mass_error>("mass_error", kPure,
                                    "by which share the law takes the ring for heavier than it is")
           .above(-1)
           .of({"sliding", "two_phase", "library"})
           .optional(),
       key<&Controller::stiffness>("stiffness", kStiffness,
                                   "of the emulated spring; of the tracking error")
           .at_least(0)
           .of({"passive", "pd"})
           .optional(),
       key<&Controller::damping>(
           "damping", kDamping,
           "of the emulated damper; of the tracking error; of the ring beside the feedback")
           .at_least(0)
           .of({"passive", "pd", "cross_coupled", "two_phase"})
           .optional(),
       key<&Controller::feedback>("feedback", kDamping, "k, one value or one for each speed")
           .at_least(0)
           .of({"cross_coupled", "two_phase"}),
       key<&Controller::feedback_speed>("feedback_speed", kSpin,
                                        "of those values, ascending; between them linear")
           .at_least(0)
           .of({"cross_coupled", "two_phase"})
           .otherwise("one value at every speed"),
       key<&Controller::handover_time>("handover_time", kTime,
                                       "in which the force of the first law fades out")
           .above(0)
           .of({"two_phase"})
           .optional(),
       key<&Controller::filter_time>(
           "filter_time", kTime,
           "of the mean of the feed-forward, in the frame of the whirl; sampled "
           "laws only")
           .at_least(0)
           .of({"sliding", "two_phase"})
           .otherwise("one turn of the spin"),
       key<&Controller::tracking_damping>(
           "tracking_damping", kDamping,
           "of the ring's velocity about its mean there; sampled laws only")
           .at_least(0)
           .of({"sliding", "two_phase"})
           .otherwise("the ring's critical one"),
       key<&Controller::allowed_error>("allowed_error", kLength,
                                       "e_0, of the rotor from the ring's centre")
           .above(0)
           .of({"lqr", "lqg"})
           .optional(),
       key<&Controller::allowed_travel>("allowed_travel", kLength, "s_0, of the ring")
           .above(0)
           .of({"lqr", "lqg"})
           .optional(),
       key<&Controller::allowed_force>("allowed_force", kForce, "u_0")
           .above(0)
           .of({"lqr", "lqg"})
           .optional(),
       key<&Controller::disturbance>(
           "disturbance", kForce, "standard deviation of forces on rotor and ring at the contact")
           .above(0)
           .of({"lqg"})
           .optional(),
       key<&Controller::measurement_error>("measurement_error", kLength,
                                           "standard deviation of the measured positions")
           .above(0)
           .of({"lqg"})
           .optional()}};
}

Controller& controller_of(Scene& scene) {
  return scene.auxiliary.back().controller ? *scene.auxiliary.back().controller
                                           : scene.auxiliary.back().controller.emplace();
}

Table sensors() {
  return {
      "controller.sensors",
      false,
      Form::kEither,
      "What a sampled controller is shown of the plant. Needs `sample_time`.",
      "the truth",
      [](Scene& scene) -> void* { return &controller_of(scene).sensors; },
      {key<&Sensors::rotor>("rotor", kPure, "the rotor is measured").optional(),
       key<&Sensors::stator>("stator", kPure, "the ring is measured").optional(),
       key<&Sensors::spin>("spin", kPure, "angle and speed of the spin are measured").optional(),
       key<&Sensors::current>("current", kPure, "the magnets' currents are measured").optional(),
       word<&Sensors::velocity>("velocity", {"measured", "difference", "none"},
                                "of rotor and ring: measured, from the positions of two samples, "
                                "or not at all")
           .optional(),
       key<&Sensors::delay>("delay", kTime,
                            "between the measurement and the command; whole samples")
           .at_least(0)
           .optional(),
       key<&Sensors::position_resolution>("position_resolution", kLength, "0: none")
           .at_least(0)
           .optional(),
       key<&Sensors::velocity_resolution>("velocity_resolution", kVelocity, "0: none")
           .at_least(0)
           .optional(),
       key<&Sensors::current_resolution>("current_resolution", kCurrent, "0: none")
           .at_least(0)
           .optional(),
       key<&Sensors::position_noise>("position_noise", kLength, "standard deviation")
           .at_least(0)
           .optional(),
       key<&Sensors::velocity_noise>("velocity_noise", kVelocity, "standard deviation")
           .at_least(0)
           .optional(),
       key<&Sensors::current_noise>("current_noise", kCurrent, "standard deviation")
           .at_least(0)
           .optional(),
       key<&Sensors::seed>("seed", kPure, "of the noise").at_least(0).optional()}};
}

Table trigger() {
  return {
      "controller.trigger",
      false,
      Form::kEither,
      "Switches a sampled controller on at the first of these, once `on` has come. Needs "
      "[contact].",
      "it is switched on at `on`",
      [](Scene& scene) -> void* { return &controller_of(scene).trigger.emplace(); },
      {key<&Trigger::gap>("gap", kLength, "measured, at which it is switched on")
           .above(0)
           .otherwise("none"),
       key<&Trigger::time_to_touch>("time_to_touch", kTime,
                                    "predicted, gap over closing rate, at which it is switched on")
           .above(0)
           .otherwise("none"),
       key<&Trigger::touch>("touch", kPure, "rotor and ring have touched").optional()}};
}

Table config() {
  return {"controller.config",
          false,
          Form::kEither,
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
