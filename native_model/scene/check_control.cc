// Cross-checks of the controller.

#include <algorithm>
#include <cmath>
#include <string>

#include "native_model/scene/checker.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

constexpr double kMostDelay = 1000.0;  // samples
constexpr const char* kSampledOnly = "needs controller.sample_time above 0: ";

// A pure function of the measurement may be continuous.
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

void check_feedback(const Checker& check, const Controller& c) {
  if (!check.sound({"controller.feedback", "controller.feedback_speed"})) return;
  if (!check.given("controller.feedback_speed")) {
    if (c.feedback.size() > 1) {
      check.fail("controller.feedback", "several values need controller.feedback_speed");
    }
    return;
  }
  check.ascending("controller.feedback_speed", c.feedback_speed);
  check.list_length("controller.feedback_speed", c.feedback_speed, c.feedback.size(),
                    "value of controller.feedback");
}

// What a built-in law reads must be measured.
void check_measured(const Checker& check, const Controller& c) {
  if (c.kind == ControllerKind::kLibrary) return;
  const bool gap = c.kind != ControllerKind::kPassive && c.kind != ControllerKind::kCrossCoupled;
  const auto needs = [&](bool measured, const char* key, const char* what) {
    if (!measured) check.fail(key, std::string("the law needs ") + what);
  };
  needs(c.sensors.stator, "controller.sensors.stator", "the ring");
  if (c.kind != ControllerKind::kLqg) {
    needs(c.sensors.velocity != VelocitySensor::kNone, "controller.sensors.velocity", "velocities");
  }
  if (gap) needs(c.sensors.rotor, "controller.sensors.rotor", "the rotor");
  const bool turns = c.kind == ControllerKind::kCrossCoupled || c.kind == ControllerKind::kTwoPhase;
  if (turns) needs(c.sensors.spin, "controller.sensors.spin", "the spin speed");
}

void check_sensors(const Checker& check, const Controller& c) {
  if (c.sample_time <= 0.0) {
    if (check.given("controller.sensors")) {
      check.fail("controller.sensors",
                 std::string(kSampledOnly) + "a continuous law is shown the truth");
    }
    return;
  }
  const double samples = c.sensors.delay / c.sample_time;
  if (samples > kMostDelay || std::abs(samples - std::round(samples)) > 1e-9 * samples) {
    check.fail("controller.sensors.delay",
               "must be a whole number of samples, up to " + number_text(kMostDelay) + ", of " +
                   number_text(c.sample_time) + " s, got " + number_text(samples));
  }
}

void check_trigger(const Checker& check, const Controller& c) {
  const auto refuse = [&](const char* key, const std::string& reason) { check.fail(key, reason); };
  const char* const key = "controller.trigger";
  if (c.sample_time <= 0.0)
    refuse(key, std::string(kSampledOnly) + "it is looked for at the samples");
  if (!check.given("contact")) refuse(key, "needs [contact]: there is no gap");
  if (!c.sensors.rotor || !c.sensors.stator) {
    refuse(key, "needs controller.sensors.rotor and .stator: it looks at the gap");
  }
  if (c.trigger->time_to_touch && c.sensors.velocity == VelocitySensor::kNone) {
    refuse("controller.trigger.time_to_touch",
           "needs controller.sensors.velocity other than \"none\"");
  }
  if (!c.trigger->gap && !c.trigger->time_to_touch && !c.trigger->touch) {
    refuse(key, "needs `gap`, `time_to_touch` or `touch`");
  }
}

}  // namespace

void check_control(const Checker& check) {
  if (!check.given("controller")) return;
  const Controller& c = *check.bearing().controller;
  if (!check.given("stator")) {
    check.fail("controller", "needs [stator]: the ring is fixed, and there is nothing to move");
  }
  if (needs_contact(c.kind) && !check.given("contact")) {
    check.fail("controller", "needs [contact]: it acts on the gap between rotor and ring");
  }
  check_feedback(check, c);
  check_measured(check, c);
  if (!check.sound({"controller.sample_time"})) return;
  if (remembers(c) && c.sample_time <= 0.0) {
    check.fail("controller.sample_time", "this law is sampled: expected a time in s, > 0");
  }
  check_sensors(check, c);
  if (c.trigger) check_trigger(check, c);
}

}  // namespace rotorub::scene
