// [controller] and the tables below it: rows and cross-checks.

#include <cmath>
#include <string>

#include "native_model/scene/reading.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

constexpr double kMostDelay = 1000.0;  // samples
constexpr const char* kSampledOnly = "needs controller.sample_time above 0: ";

Table controller() {
  return {
      "controller",
      "Commands the ring. Needs [stator]; all kinds but `passive` and `library` need [contact].",
      "no command",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().controller.emplace(); },
      {word<&Controller::kind>(
           "kind",
           {"passive", "sliding", "cross_coupled", "two_phase", "pd", "lqr", "lqg", "library"},
           kRequired,
           "`passive`: emulated spring and damper; `sliding`: sliding mode that brings the ring to "
           "the rotor; `cross_coupled`: force -k(Omega) e_z x v (ring velocity v); "
           "`two_phase`: `sliding`, from the first touch `cross_coupled`; `pd`: spring and damper "
           "on the gap's error; `lqr`, `lqg`: linear quadratic; `library`: your own"),
       key<&Controller::on>("on", kTime, "", kStandard, "start of the law or its trigger"),
       key<&Controller::sample_time>("sample_time", kTime, ">= 0", kStandard,
                                     "sampling interval; 0: continuous"),
       key<&Controller::library>("library", kPure, "", kRequired,
                                 "shared library or Python file, beside the scene or absolute",
                                 {"library"}),
       key<&Controller::bandwidth>("bandwidth", kRate, "> 0", kStandard,
                                   "psi, decay rate of the tracking error",
                                   {"sliding", "two_phase"}),
       key<&Controller::boundary_layer>("boundary_layer", kVelocity, "> 0", kStandard,
                                        "phi, half-width of the boundary layer",
                                        {"sliding", "two_phase"}),
       word<&Controller::layer>("layer", {"constant", "adaptive"}, kStandard,
                                "`adaptive`: phi moves from `boundary_layer` to k / psi",
                                {"sliding", "two_phase"}),
       key<&Controller::switching_gain>("switching_gain", kAcceleration, ">= 0", kStandard,
                                        "k, bound on the unknown acceleration",
                                        {"sliding", "two_phase"}),
       key<&Controller::gap_time>("gap_time", kTime, "> 0", kStandard,
                                  "time for the gap reference to fall to 0",
                                  {"sliding", "two_phase", "pd"}),
       key<&Controller::preload>("preload", kForce, ">= 0", kStandard,
                                 "normal force of the lasting contact",
                                 {"sliding", "two_phase", "pd"}),
       key<&Controller::mass_error>("mass_error", kPure, "> -1", kStandard,
                                    "relative error of the law's ring mass",
                                    {"sliding", "two_phase", "library"}),
       key<&Controller::stiffness>("stiffness", kStiffness, ">= 0", kStandard,
                                   "emulated spring; `pd`: gain on the tracking error",
                                   {"passive", "pd"}),
       key<&Controller::damping>(
           "damping", kDamping, ">= 0", kStandard,
           "emulated damper; `pd`: gain on the error's rate; else damping of the ring",
           {"passive", "pd", "cross_coupled", "two_phase"}),
       key<&Controller::feedback>("feedback", kDamping, ">= 0", kRequired,
                                  "k: one value, as `[200]`, or one per speed",
                                  {"cross_coupled", "two_phase"}),
       key<&Controller::feedback_speed>("feedback_speed", kSpin, ">= 0", "constant k",
                                        "ascending speeds for these values; linear in between",
                                        {"cross_coupled", "two_phase"}),
       key<&Controller::handover_time>("handover_time", kTime, "> 0", kStandard,
                                       "fade-out time of the `sliding` force", {"two_phase"}),
       key<&Controller::filter_time>("filter_time", kTime, ">= 0", "one turn of the spin",
                                     "averaging time of a sampled feed-forward",
                                     {"sliding", "two_phase"}),
       key<&Controller::tracking_damping>("tracking_damping", kDamping, ">= 0", "critical damping",
                                          "of the ring about its mean velocity (sampled laws)",
                                          {"sliding", "two_phase"}),
       key<&Controller::allowed_error>("allowed_error", kLength, "> 0", kStandard,
                                       "e_0, allowed distance of the centres", {"lqr", "lqg"}),
       key<&Controller::allowed_travel>("allowed_travel", kLength, "> 0", kStandard,
                                        "s_0, allowed ring travel", {"lqr", "lqg"}),
       key<&Controller::allowed_force>("allowed_force", kForce, "> 0", kStandard,
                                       "u_0, allowed actuator force", {"lqr", "lqg"}),
       key<&Controller::disturbance>("disturbance", kForce, "> 0", kStandard,
                                     "standard deviation of forces at the contact", {"lqg"}),
       key<&Controller::measurement_error>("measurement_error", kLength, "> 0", kStandard,
                                           "standard deviation of measured positions", {"lqg"})}};
}

Table sensors() {
  return {"controller.sensors",
          "What a sampled controller measures. Noise has these standard deviations. "
          "Needs `sample_time`.",
          "exact values",
          [](Scene& scene) -> void* { return &scene.auxiliary.back().controller->sensors; },
          {key<&Sensors::rotor>("rotor", kPure, "", kStandard, "whether it is measured"),
           key<&Sensors::stator>("stator", kPure, "", kStandard, "whether it is measured"),
           key<&Sensors::spin>("spin", kPure, "", kStandard, "whether it is measured"),
           key<&Sensors::current>("current", kPure, "", kStandard, "whether it is measured"),
           word<&Sensors::velocity>("velocity", {"measured", "difference", "none"}, kStandard,
                                    "measured, from two positions, or unknown"),
           key<&Sensors::delay>("delay", kTime, ">= 0", kStandard,
                                "from measurement to command, a multiple of `sample_time`"),
           key<&Sensors::position_resolution>("position_resolution", kLength, ">= 0", kStandard,
                                              "rounding of positions"),
           key<&Sensors::velocity_resolution>("velocity_resolution", kVelocity, ">= 0", kStandard,
                                              "rounding of velocities"),
           key<&Sensors::current_resolution>("current_resolution", kCurrent, ">= 0", kStandard,
                                             "rounding of currents"),
           key<&Sensors::position_noise>("position_noise", kLength, ">= 0", kStandard,
                                         "noise of positions"),
           key<&Sensors::velocity_noise>("velocity_noise", kVelocity, ">= 0", kStandard,
                                         "noise of velocities"),
           key<&Sensors::current_noise>("current_noise", kCurrent, ">= 0", kStandard,
                                        "noise of currents"),
           key<&Sensors::seed>("seed", kPure, ">= 0", kStandard, "seed of the noise")}};
}

Table trigger() {
  return {
      "controller.trigger",
      "After `on`, the first condition switches a sampled controller on. Needs "
      "[contact].",
      "it starts at `on`",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().controller->trigger.emplace(); },
      {key<&Trigger::gap>("gap", kLength, "> 0", "none", "measured gap is below this"),
       key<&Trigger::time_to_touch>("time_to_touch", kTime, "> 0", "none",
                                    "gap / closing rate is below this"),
       key<&Trigger::touch>("touch", kPure, "", kStandard, "rotor and ring have touched")}};
}

Table config() {
  return {"controller.config",
          "Any keys for your own controller: numbers and texts.",
          "nothing",
          [](Scene& scene) -> void* { return &scene.auxiliary.back().controller->config; },
          {},
          {"library"},
          true};
}

// False for a pure function of the measurement, which may be continuous.
bool remembers(const Controller& c) {
  switch (c.kind) {
    case ControllerKind::kTwoPhase:
    case ControllerKind::kLqr:
    case ControllerKind::kLqg:
    case ControllerKind::kLibrary:
      return true;
    default:
      return c.layer == BoundaryLayer::kAdaptive;
  }
}

bool needs_contact(ControllerKind kind) {
  return kind != ControllerKind::kPassive && kind != ControllerKind::kLibrary;
}

void check_feedback(const Reading& check, const Controller& c) {
  if (!check.sound({"controller.feedback", "controller.feedback_speed"})) return;
  if (!check.given("controller.feedback_speed")) {
    if (c.feedback.size() > 1) {
      check.fail("controller.feedback", "several values need controller.feedback_speed");
    }
    return;
  }
  check.ascending("controller.feedback_speed", c.feedback_speed);
  check.list_length("controller.feedback_speed", c.feedback.size(), "value of controller.feedback");
}

// A built-in law needs the measurements that it reads.
void check_measured(const Reading& check, const Controller& c) {
  if (c.kind == ControllerKind::kLibrary) return;
  const bool gap = c.kind != ControllerKind::kPassive && c.kind != ControllerKind::kCrossCoupled;
  const auto needs = [&](bool measured, const char* key, const char* what) {
    if (!measured)
      check.fail(key, std::string("must not be switched off, because the law needs ") + what);
  };
  needs(c.sensors.stator, "controller.sensors.stator", "the ring");
  if (c.kind != ControllerKind::kLqg) {
    needs(c.sensors.velocity != VelocitySensor::kNone, "controller.sensors.velocity", "velocities");
  }
  if (gap) needs(c.sensors.rotor, "controller.sensors.rotor", "the rotor");
  const bool turns = c.kind == ControllerKind::kCrossCoupled || c.kind == ControllerKind::kTwoPhase;
  if (turns) needs(c.sensors.spin, "controller.sensors.spin", "the spin speed");
}

void check_sensors(const Reading& check, const Controller& c) {
  if (c.sample_time <= 0.0) {
    if (check.given("controller.sensors")) {
      check.fail("controller.sensors",
                 std::string(kSampledOnly) + "a continuous law measures everything exactly");
    }
    return;
  }
  const double samples = c.sensors.delay / c.sample_time;
  if (samples > kMostDelay || std::abs(samples - std::round(samples)) > 1e-9 * samples) {
    check.fail("controller.sensors.delay",
               "must be a multiple of controller.sample_time = " + number_text(c.sample_time) +
                   " s, up to " + number_text(kMostDelay) + " times, got " +
                   number_text(c.sensors.delay) + " s");
  }
}

void check_trigger(const Reading& check, const Controller& c) {
  const char* const key = "controller.trigger";
  if (c.sample_time <= 0.0)
    check.fail(key, std::string(kSampledOnly) + "it is checked at the samples");
  check.needs(key, "[contact]", ": there is no gap");
  if (!c.sensors.rotor || !c.sensors.stator) {
    check.fail(
        key,
        "needs controller.sensors.rotor = true and controller.sensors.stator = true, which measure "
        "the gap");
  }
  if (c.trigger->time_to_touch && c.sensors.velocity == VelocitySensor::kNone) {
    check.fail("controller.trigger.time_to_touch",
               "needs controller.sensors.velocity other than \"none\"");
  }
  if (!c.trigger->gap && !c.trigger->time_to_touch && !c.trigger->touch) {
    check.fail(key, "needs `gap`, `time_to_touch` or `touch`");
  }
}

}  // namespace

std::vector<Table> control_tables() { return {controller(), sensors(), trigger(), config()}; }

void check_control(const Reading& check) {
  if (!check.bearing().controller) return;
  const Controller& c = *check.bearing().controller;
  check.needs("controller", "[stator]",
              check.scene.magnetic_bearings.empty()
                  ? ": the ring is fixed, and there is nothing to move"
                  : ": it moves a ring. A law for magnetic bearings belongs in [magnetic_control]");
  if (needs_contact(c.kind)) {
    check.needs("controller", "[contact]", ": it acts on the gap between rotor and ring");
  }
  check_feedback(check, c);
  check_measured(check, c);
  if (!check.sound({"controller.sample_time"})) return;
  if (remembers(c) && c.sample_time <= 0.0) {
    check.fail("controller.sample_time",
               "must be > 0, because this law is sampled. Add, for example, --set "
               "controller.sample_time=50us");
  }
  check_sensors(check, c);
  if (c.trigger) check_trigger(check, c);
}

}  // namespace rotorub::scene
