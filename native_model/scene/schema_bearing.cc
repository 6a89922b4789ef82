// The rows of the auxiliary bearing: contact, ring, actuator.

#include "native_model/scene/schema.h"

namespace rotorub::scene {
namespace {

Table contact() {
  return {
      "contact",
      false,
      Form::kEither,
      "The rotor in the ring of the auxiliary bearing. Of several bearings each is a "
      "`[[contact]]`, with its ring, "
      "actuator and controller below it: `[contact.stator]`, `[contact.actuator]`, "
      "`[contact.controller]` take the "
      "keys of `[stator]`, `[actuator]`, `[controller]`, which then do not stand by themselves.",
      "no contact",
      [](Scene& scene) -> void* {
        scene.auxiliary.back().contact.emplace();
        return &scene.auxiliary.back();
      },
      {key<&AuxiliaryBearing::contact, &Contact::radius>("radius", kLength,
                                                         "of the rotor at the contact")
           .above(0),
       key<&AuxiliaryBearing::contact, &Contact::clearance>("clearance", kLength, "delta_0, radial")
           .above(0),
       key<&AuxiliaryBearing::contact, &Contact::friction, &FrictionLaw::coefficient>("friction",
                                                                                      kPure, "mu")
           .at_least(0),
       key<&AuxiliaryBearing::contact, &Contact::restitution>("restitution", kPure, "eps_N, normal")
           .between(0, 1),
       key<&AuxiliaryBearing::contact, &Contact::tangential_restitution>("tangential_restitution",
                                                                         kPure, "eps_T")
           .between(0, 1)
           .optional(),
       key<&AuxiliaryBearing::contact, &Contact::compression_time>("compression_time", kTime,
                                                                   "tau_C")
           .at_least(0)
           .optional(),
       key<&AuxiliaryBearing::contact, &Contact::expansion_time>("expansion_time", kTime, "tau_E")
           .at_least(0)
           .optional(),
       key<&AuxiliaryBearing::contact, &Contact::station>("station", kLength, "along the shaft")
           .or_called("z")
           .at_least(0)
           .in(Form::kGeometry),
       key<&AuxiliaryBearing::contact, &Contact::offset>(
           "offset", kLength, "of the ring's middle at rest from the line of the shaft at rest")
           .optional(),
       key<&AuxiliaryBearing::name>("name", kPure,
                                    "of this bearing, unique; in messages and pictures")
           .otherwise("its number, from 1"),
       key<&AuxiliaryBearing::contact, &Contact::shape>(
           "shape", kPure,
           "value of each bending mode at the station; 1 of the first "
           "contact, where the modes are scaled")
           .in(Form::kModal)
           .otherwise("all 1"),
       key<&AuxiliaryBearing::contact, &Contact::torsion_shape>("torsion_shape", kPure,
                                                                "the same of each torsion mode")
           .in(Form::kModal)
           .otherwise("all 1")}};
}

Table stator() {
  return {"stator",
          false,
          Form::kEither,
          "The movable ring of the auxiliary bearing.",
          "the ring is fixed to the base",
          [](Scene& scene) -> void* { return &scene.auxiliary.back().stator.emplace(); },
          {planes<&Stator::mass>("mass", kMass, "").above(0),
           planes<&Stator::damping>("damping", kDamping, "to the base").at_least(0).optional(),
           planes<&Stator::stiffness>("stiffness", kStiffness,
                                      "mechanical spring to the base, always acting")
               .at_least(0),
           key<&Stator::position>("position", kLength, "at t = 0, from where it is at rest")
               .below_list()
               .otherwise("[0, 0]; of `[stator]` `initial.stator`"),
           key<&Stator::velocity>("velocity", kVelocity, "at t = 0")
               .below_list()
               .otherwise("[0, 0]; of `[stator]` `initial.stator_velocity`")}};
}

Table ring_spin() {
  return {
      "stator.spin",
      false,
      Form::kEither,
      "The ring turns about its axis, as the inner ring of a ball bearing: the rub spins it up. "
      "Needs [contact].",
      "the ring does not turn",
      [](Scene& scene) -> void* {
        if (!scene.auxiliary.back().stator) scene.auxiliary.back().stator.emplace();
        return &scene.auxiliary.back().stator->spin.emplace();
      },
      {key<&RingSpin::inertia>("inertia", kInertia, "polar, of all that turns with the ring")
           .above(0),
       key<&RingSpin::drag>("drag", kAngularDamping, "viscous, to the base").at_least(0).optional(),
       key<&RingSpin::speed>("speed", kSpin, "at t = 0").optional()}};
}

Table actuator() {
  return {
      "actuator",
      false,
      Form::kEither,
      "The two axes that move the ring, at 45 degrees: (1, 1)/sqrt 2 and (-1, 1)/sqrt 2. Needs "
      "[stator].",
      "an ideal, unlimited force",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().actuator.emplace(); },
      {word<&Actuator::kind>(
           "kind", {"ideal", "electromagnet", "table"},
           "the force that is asked for; F(s, i) = `force_constant` [((`bias_current` + "
           "i)/(`air_gap` - s))^2 - ((`bias_current` - i)/(`air_gap` + s))^2] - `stiffness` s, "
           "s and i on each axis; F(s, i) by a bicubic spline through a table")
           .optional(),
       key<&Actuator::force_limit>("force_limit", kForce, "on each axis")
           .above(0)
           .of({"ideal"})
           .otherwise("none"),
       key<&Actuator::force_constant>("force_constant", kMagnetConstant, "k_m")
           .above(0)
           .of({"electromagnet"}),
       key<&Actuator::bias_current>("bias_current", kCurrent, "i_0, in both magnets")
           .above(0)
           .of({"electromagnet"}),
       key<&Actuator::air_gap>("air_gap", kLength, "s_0, of each magnet at s = 0")
           .above(0)
           .of({"electromagnet"}),
       key<&Actuator::stiffness>("stiffness", kStiffness, "c, of the actuator's own spring")
           .at_least(0)
           .of({"electromagnet"})
           .optional(),
       key<&Actuator::table_position>("table_position", kLength,
                                      "values of s, ascending, four or more")
           .of({"table"}),
       key<&Actuator::table_current>("table_current", kCurrent,
                                     "values of i, ascending through 0, four or more")
           .of({"table"}),
       key<&Actuator::table_force>("table_force", kForce,
                                   "for each position, one after the other, the forces at all "
                                   "currents; rising with the current")
           .of({"table"}),
       key<&Actuator::current_limit>("current_limit", kCurrent,
                                     "of the current i that is asked for")
           .above(0)
           .of({"electromagnet", "table"})
           .otherwise("the most that is accepted: `bias_current`, or what the table covers"),
       key<&Actuator::coil_lag>("coil_lag", kTime,
                                "the coil's current follows: `coil_lag` di/dt = asked - i; 0: "
                                "at once")
           .at_least(0)
           .of({"electromagnet", "table"})
           .optional(),
       key<&Actuator::current_rate_limit>("current_rate_limit", kCurrentRate,
                                          "of the size of di/dt, the voltage over the "
                                          "inductance; needs `coil_lag`")
           .above(0)
           .of({"electromagnet", "table"})
           .otherwise("none"),
       key<&Actuator::voltage_limit>("voltage_limit", kVoltage,
                                     "of the size of u, which drives the coil: `inductance` di/dt "
                                     "= u - `resistance` i; needs `coil_lag`, `inductance`")
           .above(0)
           .of({"electromagnet", "table"})
           .otherwise("none"),
       key<&Actuator::inductance>("inductance", kInductance,
                                  "of the coil of an axis; needs `voltage_limit`")
           .above(0)
           .of({"electromagnet", "table"})
           .otherwise("none"),
       key<&Actuator::resistance>("resistance", kResistance,
                                  "of the coil of an axis; needs `voltage_limit`")
           .at_least(0)
           .of({"electromagnet", "table"})
           .optional()}};
}

}  // namespace

std::vector<Table> bearing_tables() {
  std::vector<Table> all{contact(), stator(), ring_spin(), actuator()};
  all.front().or_list = true;
  return all;
}

}  // namespace rotorub::scene
