// [stator] of an auxiliary bearing and the tables below it: rows and cross-checks.

#include "native_model/scene/reading.h"
#include "native_model/scene/schema.h"

namespace rotorub::scene {
namespace {

Table stator() {
  return {
      "stator",
      "The movable ring of the auxiliary bearing.",
      "the ring is fixed",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().stator.emplace(); },
      {planes<&Stator::mass>("mass", kMass, "> 0", kRequired, "ring mass"),
       planes<&Stator::damping>("damping", kDamping, ">= 0", kStandard,
                                "damping to base or housing"),
       planes<&Stator::stiffness>("stiffness", kStiffness, ">= 0", kRequired,
                                  "spring to base or housing"),
       key<&Stator::position>(
           "position", kLength, "", "[0, 0]",
           "position at t = 0, from rest; only in [contact.stator] (else `initial.stator`)")
           .below_list(),
       key<&Stator::velocity>("velocity", kVelocity, "", "[0, 0]", "velocity at t = 0, likewise")
           .below_list()}};
}

Table ring_spin() {
  return {"stator.spin",
          "The rub spins the ring.",
          "the ring does not turn",
          [](Scene& scene) -> void* { return &scene.auxiliary.back().stator->spin.emplace(); },
          {key<&RingSpin::inertia>("inertia", kInertia, "> 0", kRequired,
                                   "polar inertia of all turning parts"),
           key<&RingSpin::drag>("drag", kAngularDamping, ">= 0", kStandard, "viscous drag"),
           key<&RingSpin::speed>("speed", kSpin, "", kStandard, "ring speed at t = 0"),
           key<&RingSpin::dry_drag>("dry_drag", kTorque, ">= 0", kStandard,
                                    "dry friction torque at no load"),
           key<&RingSpin::load_factor>(
               "load_factor", kPure, ">= 0", kStandard,
               "f_1 of Palmgren's torque f_1 P `pitch_diameter` under the load P"),
           key<&RingSpin::pitch_diameter>("pitch_diameter", kLength, "> 0", "none",
                                          "pitch diameter of the balls; needs `load_factor`"),
           key<&RingSpin::presliding_angle>("presliding_angle", kAngle, "> 0", kStandard,
                                            "angle over which these torques build up")}};
}

Table mount() {
  return {
      "stator.mount",
      "A housing between ring and base. `stator.stiffness`, `stator.damping` and the tables below "
      "act between ring and housing; the actuator stands on the base.",
      "the base carries the ring",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().stator->mount.emplace(); },
      {planes<&Housing::mass>("mass", kMass, "> 0", kRequired, "housing mass"),
       planes<&Housing::stiffness>("stiffness", kStiffness, ">= 0", kRequired,
                                   "stiffness to the base"),
       planes<&Housing::damping>("damping", kDamping, ">= 0", kStandard, "damping to the base")}};
}

Table dry_friction() {
  return {
      "stator.dry_friction",
      "Dahl's dry friction under the ring (tolerance ring, friction damper).",
      "none",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().stator->dry_friction.emplace(); },
      {key<&DryFriction::force>("force", kForce, "> 0", kRequired, "force at full slip"),
       key<&DryFriction::presliding>("presliding", kLength, "> 0", kRequired,
                                     "distance over which it builds up")}};
}

Table squeeze_film() {
  return {
      "stator.squeeze_film",
      "A squeeze film around the ring (short-bearing theory).",
      "none",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().stator->squeeze_film.emplace(); },
      {key<&SqueezeFilm::radius>("radius", kLength, "> 0", kRequired, "outer ring radius"),
       key<&SqueezeFilm::length>("length", kLength, "> 0", kRequired, "axial length"),
       key<&SqueezeFilm::clearance>(
           "clearance", kLength, "> 0", kRequired,
           "radial clearance; the run ends if the ring reaches 99 % of it"),
       key<&SqueezeFilm::viscosity>("viscosity", kViscosity, "> 0", kRequired, "oil viscosity"),
       key<&SqueezeFilm::cavitation>("cavitation", kPure, "", kStandard,
                                     "no tension: the film acts on half of the ring")}};
}

Table ball_bearing() {
  return {
      "stator.ball_bearing",
      "The balls that carry the ring, by Hertz's law.",
      "none",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().stator->ball_bearing.emplace(); },
      {key<&BallSupport::balls>("balls", kPure, "in [3, 100]", kRequired, "number of balls"),
       key<&BallSupport::stiffness>("stiffness", kPure, "> 0", kRequired,
                                    "of one ball between both races, N/m^1.5"),
       key<&BallSupport::play>("play", kLength, ">= 0", kStandard,
                               "travel before a ball carries load"),
       key<&BallSupport::phase>("phase", kAngle, "", kStandard,
                                "first ball's angle from the x axis")}};
}

void check_spin(const Reading& check, const RingSpin& spin) {
  const bool loaded = spin.load_factor > 0.0;
  if (loaded && !check.given("stator.spin.pitch_diameter")) {
    check.fail("stator.spin.load_factor",
               "needs stator.spin.pitch_diameter: the torque is load_factor P pitch_diameter");
  }
  if (!loaded && check.given("stator.spin.pitch_diameter")) {
    check.fail("stator.spin.pitch_diameter", "needs stator.spin.load_factor above 0");
  }
  if (!spin.drags() && check.given("stator.spin.presliding_angle")) {
    check.fail("stator.spin.presliding_angle",
               "needs stator.spin.dry_drag or stator.spin.load_factor above 0");
  }
}

}  // namespace

std::vector<Table> ring_tables() {
  return {stator(), ring_spin(), mount(), dry_friction(), squeeze_film(), ball_bearing()};
}

void check_ring(const Reading& check) {
  const AuxiliaryBearing& bearing = check.bearing();
  if (bearing.contact) check.station("contact.station", bearing.contact->station);
  if (bearing.actuator)
    check.needs("actuator", "[stator]", ": the ring is fixed, and there is nothing to move");
  if (bearing.stator && bearing.stator->spin) {
    check.needs("stator.spin", "[contact]", ": nothing else turns the ring");
    check_spin(check, *bearing.stator->spin);
  }
  if (check.index > 0) return;
  for (const char* key : {"initial.stator", "initial.stator_velocity"}) {
    if (check.given(key) && check.given("contact[0]")) {
      check.fail(key,
                 "cannot be used with [[contact]]; give position and velocity in each "
                 "[contact.stator]");
    } else {
      check.needs(key, "[stator]", ": the ring is fixed and stays at [0, 0]");
    }
  }
}

}  // namespace rotorub::scene
