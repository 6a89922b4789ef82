// [contact], [stator] and [actuator] of an auxiliary bearing: rows, and what single keys cannot
// show.

#include <algorithm>
#include <functional>

#include "native_model/scene/checker.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

Table contact() {
  return {"contact",
          "The rotor in the ring of the auxiliary bearing. Of several bearings each is a "
          "`[[contact]]`, with its ring, actuator and controller below it: `[contact.stator]`, "
          "`[contact.actuator]`, `[contact.controller]` take the keys of `[stator]`, `[actuator]`, "
          "`[controller]`, which then do not stand by themselves.",
          "no contact",
          [](Scene& scene) -> void* {
            scene.auxiliary.back().contact.emplace();
            return &scene.auxiliary.back();
          },
          {key<&AuxiliaryBearing::contact, &Contact::radius>("radius", kLength, "> 0", kRequired,
                                                             "of the rotor at the contact"),
           key<&AuxiliaryBearing::contact, &Contact::clearance>("clearance", kLength, "> 0",
                                                                kRequired, "delta_0, radial"),
           key<&AuxiliaryBearing::contact, &Contact::friction, &FrictionLaw::coefficient>(
               "friction", kPure, ">= 0", kRequired, "mu; or the table `[contact.friction]`"),
           key<&AuxiliaryBearing::contact, &Contact::restitution>(
               "restitution", kPure, "in [0, 1]",
               "none: to be given, but where `contact.compliance` has a damping of its own",
               "eps_N, normal"),
           key<&AuxiliaryBearing::contact, &Contact::tangential_restitution>(
               "tangential_restitution", kPure, "in [0, 1]", kStandard, "eps_T"),
           key<&AuxiliaryBearing::contact, &Contact::compression_time>("compression_time", kTime,
                                                                       ">= 0", kStandard, "tau_C"),
           key<&AuxiliaryBearing::contact, &Contact::expansion_time>("expansion_time", kTime,
                                                                     ">= 0", kStandard, "tau_E"),
           key<&AuxiliaryBearing::contact, &Contact::station>("station", kLength, ">= 0", kRequired,
                                                              "along the shaft")
               .or_called("z")
               .in(Form::kGeometry),
           key<&AuxiliaryBearing::contact, &Contact::offset>(
               "offset", kLength, "", kStandard,
               "of the ring's middle at rest from the line of the shaft at rest"),
           key<&AuxiliaryBearing::name>("name", kPure, "", "its number, from 1",
                                        "of this bearing, unique; in messages and pictures"),
           key<&AuxiliaryBearing::contact, &Contact::shape>(
               "shape", kPure, "", "all 1",
               "value of each bending mode at the station; 1 of the first contact, where the modes "
               "are scaled")
               .in(Form::kModal),
           key<&AuxiliaryBearing::contact, &Contact::torsion_shape>(
               "torsion_shape", kPure, "", "all 1", "the same of each torsion mode")
               .in(Form::kModal)}};
}

Table compliance() {
  return {
      "contact.compliance",
      "The contact gives: of a depth p it presses with N = `stiffness` p^`exponent` (1 + a p'), "
      "while that is above 0. a is `hunt_crossley`; or, where neither it nor `damping` is given, "
      "that of `restitution` for the speed of each touch, by which free masses rebound so: ln[(1 + "
      "a v)/(1 - a e v)] = a v (1 + e), e at least 0.01 and v at least 0.1 mm/s. Friction is that "
      "of N, and sticks without giving.",
      "the contact is rigid",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().contact->compliance.emplace(); },
      {key<&Compliance::stiffness>("stiffness", kContactStiffness, "> 0", kRequired, "k"),
       key<&Compliance::exponent>("exponent", kPure, "in [1, 2]", kStandard,
                                  "n; 1: line contact, 1.5: Hertz's point contact"),
       key<&Compliance::hunt_crossley>("hunt_crossley", kTimePerLength, ">= 0",
                                       "that of `restitution`", "a"),
       key<&Compliance::damping>("damping", kDamping, ">= 0", "none",
                                 "c of N = k p + c p', instead of a; with `exponent` = 1 alone")}};
}

// static is kept as what it is beyond kinetic, which stands before it.
Table friction() {
  Key rest = key<&FrictionLaw::excess>("static", kPure, ">= 0", kRequired, "mu(0)");
  rest.store = [](void* object, const Value& value) {
    FrictionLaw& law = *static_cast<FrictionLaw*>(object);
    law.excess = value.number - law.coefficient;
  };
  return {
      "contact.friction",
      "Friction that depends on the slip v, in the place of the number: mu(v) = kinetic + "
      "(static - kinetic) exp(-(v / stribeck_speed)^2) + viscous |v|. `friction = { static = "
      "0.3, kinetic = 0.15, stribeck_speed = 0.1 }` is the same.",
      "mu is the same at every slip",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().contact->friction; },
      {key<&FrictionLaw::coefficient>("kinetic", kPure, ">= 0", kRequired, "of fast sliding"), rest,
       key<&FrictionLaw::stribeck_speed>("stribeck_speed", kVelocity, "> 0",
                                         "needed where static > kinetic",
                                         "at which 63 % of what is beyond kinetic has gone"),
       key<&FrictionLaw::viscous>("viscous", kSlowness, ">= 0", kStandard,
                                  "by how much mu grows with the slip")}};
}

Table stator() {
  return {"stator",
          "The movable ring of the auxiliary bearing.",
          "the ring is fixed to the base",
          [](Scene& scene) -> void* { return &scene.auxiliary.back().stator.emplace(); },
          {planes<&Stator::mass>("mass", kMass, "> 0", kRequired, ""),
           planes<&Stator::damping>("damping", kDamping, ">= 0", kStandard, "to the base"),
           planes<&Stator::stiffness>("stiffness", kStiffness, ">= 0", kRequired,
                                      "mechanical spring to the base, always acting"),
           key<&Stator::position>("position", kLength, "", "[0, 0]; of `[stator]` `initial.stator`",
                                  "at t = 0, from where it is at rest")
               .below_list(),
           key<&Stator::velocity>("velocity", kVelocity, "",
                                  "[0, 0]; of `[stator]` `initial.stator_velocity`", "at t = 0")
               .below_list()}};
}

Table ring_spin() {
  return {"stator.spin",
          "The ring turns about its axis, as the inner ring of a ball bearing: the rub spins it "
          "up. Needs [contact].",
          "the ring does not turn",
          [](Scene& scene) -> void* {
            if (!scene.auxiliary.back().stator) scene.auxiliary.back().stator.emplace();
            return &scene.auxiliary.back().stator->spin.emplace();
          },
          {key<&RingSpin::inertia>("inertia", kInertia, "> 0", kRequired,
                                   "polar, of all that turns with the ring"),
           key<&RingSpin::drag>("drag", kAngularDamping, ">= 0", kStandard, "viscous, to the base"),
           key<&RingSpin::speed>("speed", kSpin, "", kStandard, "at t = 0")}};
}

Table actuator() {
  return {
      "actuator",
      "The two axes that move the ring, at 45 degrees: (1, 1)/sqrt 2 and (-1, 1)/sqrt 2. Needs "
      "[stator].",
      "an ideal, unlimited force",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().actuator.emplace(); },
      {word<&Actuator::kind>(
           "kind", {"ideal", "electromagnet", "table"}, kStandard,
           "the force that is asked for; F(s, i) = `force_constant` [((`bias_current` + "
           "i)/(`air_gap` - s))^2 - ((`bias_current` - i)/(`air_gap` + s))^2] - `stiffness` s, s "
           "and i on each axis; F(s, i) by a bicubic spline through a table"),
       key<&Actuator::force_limit>("force_limit", kForce, "> 0", "none", "on each axis", {"ideal"}),
       key<&Actuator::force_constant>("force_constant", kMagnetConstant, "> 0", kRequired, "k_m",
                                      {"electromagnet"}),
       key<&Actuator::bias_current>("bias_current", kCurrent, "> 0", kRequired,
                                    "i_0, in both magnets", {"electromagnet"}),
       key<&Actuator::air_gap>("air_gap", kLength, "> 0", kRequired, "s_0, of each magnet at s = 0",
                               {"electromagnet"}),
       key<&Actuator::stiffness>("stiffness", kStiffness, ">= 0", kStandard,
                                 "c, of the actuator's own spring", {"electromagnet"}),
       key<&Actuator::table_position>("table_position", kLength, "", kRequired,
                                      "values of s, ascending, four or more", {"table"}),
       key<&Actuator::table_current>("table_current", kCurrent, "", kRequired,
                                     "values of i, ascending through 0, four or more", {"table"}),
       key<&Actuator::table_force>("table_force", kForce, "", kRequired,
                                   "for each position, one after the other, the forces at all "
                                   "currents; rising with the current",
                                   {"table"}),
       key<&Actuator::current_limit>(
           "current_limit", kCurrent, "> 0",
           "the most that is accepted: `bias_current`, or what the table covers",
           "of the current i that is asked for", {"electromagnet", "table"}),
       key<&Actuator::coil_lag>(
           "coil_lag", kTime, ">= 0", kStandard,
           "the coil's current follows: `coil_lag` di/dt = asked - i; 0: at once",
           {"electromagnet", "table"}),
       key<&Actuator::current_rate_limit>(
           "current_rate_limit", kCurrentRate, "> 0", "none",
           "of the size of di/dt, the voltage over the inductance; needs `coil_lag`",
           {"electromagnet", "table"}),
       key<&Actuator::voltage_limit>("voltage_limit", kVoltage, "> 0", "none",
                                     "of the size of u, which drives the coil: `inductance` di/dt "
                                     "= u - `resistance` i; needs `coil_lag`, `inductance`",
                                     {"electromagnet", "table"}),
       key<&Actuator::inductance>("inductance", kInductance, "> 0", "none",
                                  "of the coil of an axis; needs `voltage_limit`",
                                  {"electromagnet", "table"}),
       key<&Actuator::resistance>("resistance", kResistance, ">= 0", kStandard,
                                  "of the coil of an axis; needs `voltage_limit`",
                                  {"electromagnet", "table"})}};
}

void check_ring(const Checker& check) {
  const AuxiliaryBearing& bearing = check.bearing();
  const bool has_ring = check.given("stator");
  if (bearing.contact) check.station("contact.station", bearing.contact->station);
  if (bearing.actuator && !has_ring) {
    check.fail("actuator", "needs [stator]: the ring is fixed, and there is nothing to move");
  }
  if (bearing.stator && bearing.stator->spin && !check.given("contact")) {
    check.fail("stator.spin", "needs [contact]: nothing else turns the ring");
  }
  for (const char* key : {"initial.stator", "initial.stator_velocity"}) {
    if (!check.given(key) || check.index > 0) continue;
    if (check.given("contact[0]")) {
      check.fail(key,
                 "is not known beside [[contact]]; accepted: position and velocity in each "
                 "[contact.stator]");
    } else if (!has_ring) {
      check.fail(key, "needs [stator]: the ring is fixed and stays at [0, 0]");
    }
  }
}

void check_force_table(const Checker& check, const Actuator& actuator) {
  constexpr std::size_t kLeast = 4;  // of a cubic
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
    } else if (std::adjacent_find(list->begin(), list->end(), std::greater_equal<>()) !=
               list->end()) {
      refuse(key, "must be strictly ascending");
    }
  }
  if (sound && !(current.front() < 0.0 && current.back() > 0.0)) {
    refuse("actuator.table_current", "must reach from below 0 to above 0");
  }
  if (!sound || !check.given("actuator.table_force") || !check.sound({"actuator.table_force"})) {
    return;
  }
  const std::vector<double>& force = actuator.table_force;
  if (force.size() != position.size() * current.size()) {
    return check.fail("actuator.table_force",
                      "expected " + std::to_string(position.size() * current.size()) +
                          " values, for each position one for each current, got " +
                          std::to_string(force.size()));
  }
  const double most = std::min(-current.front(), current.back());
  if (check.sound({"actuator.current_limit"}) && actuator.current_limit > most) {
    check.fail("actuator.current_limit",
               "must be within the table, at most " + number_text(most) + " A");
  }
}

void check_actuator(const Checker& check, const Actuator& actuator) {
  if (actuator.kind == ActuatorKind::kIdeal) return;
  if (actuator.kind == ActuatorKind::kTable) check_force_table(check, actuator);
  if (actuator.kind == ActuatorKind::kElectromagnet &&
      check.sound({"actuator.bias_current", "actuator.current_limit"}) &&
      actuator.current_limit > actuator.bias_current) {
    check.fail("actuator.current_limit",
               "must be at most actuator.bias_current = " + number_text(actuator.bias_current) +
                   " A: beyond it a magnet's current would turn round");
  }
  for (const char* key : {"actuator.current_rate_limit", "actuator.voltage_limit"}) {
    if (check.given(key) && actuator.coil_lag == 0.0 && check.sound({"actuator.coil_lag"})) {
      check.fail(key, "needs actuator.coil_lag: without it the current follows at once");
    }
  }
  const bool limited = check.given("actuator.voltage_limit");
  if (limited && !check.given("actuator.inductance")) {
    check.fail("actuator.voltage_limit",
               "needs actuator.inductance: inductance di/dt = u - resistance i");
  }
  for (const char* key : {"actuator.inductance", "actuator.resistance"}) {
    if (!limited && check.given(key)) {
      check.fail(key, "needs actuator.voltage_limit: a voltage without limit gives every current");
    }
  }
}

// Mode values at the station; the first contact is where the modes are scaled to 1.
void check_contact_shapes(const Checker& check) {
  if (!check.bearing().contact) return;
  const Contact& contact = *check.bearing().contact;
  const auto one = [&](const char* key, const std::vector<double>& shape,
                       std::optional<std::size_t> modes, const char* of) {
    if (modes) check.list_length(key, shape, *modes, of);
    if (check.index > 0 ||
        std::all_of(shape.begin(), shape.end(), [](double s) { return s == 1.0; }))
      return;
    check.fail(key,
               "must be 1 for each mode, as the modes are scaled to 1 at the first contact; "
               "accepted: modes scaled so, or another contact first");
  };
  one("contact.shape", contact.shape, check.bending_modes(), "bending mode");
  one("contact.torsion_shape", contact.torsion_shape, check.torsion_modes(), "torsion mode");
}

void check_compliance(const Checker& check) {
  if (!check.bearing().contact) return;
  const Contact& contact = *check.bearing().contact;
  const bool damped = contact.compliance && !contact.compliance->by_restitution();
  if (!check.given("contact.restitution") && !damped) {
    check.fail("contact.restitution", "missing: expected a pure number, in [0, 1]");
  }
  if (!contact.compliance) return;
  if (contact.compliance->damping && contact.compliance->hunt_crossley) {
    check.fail("contact.compliance.damping",
               "stands beside contact.compliance.hunt_crossley; give one of them");
  }
  if (contact.compliance->damping && contact.compliance->exponent != 1.0) {
    check.fail("contact.compliance.damping",
               "belongs to exponent = 1; accepted with another: hunt_crossley, or restitution");
  }
  for (const auto& [key, value] :
       {std::pair("contact.compression_time", contact.compression_time),
        std::pair("contact.expansion_time", contact.expansion_time),
        std::pair("contact.tangential_restitution", contact.tangential_restitution)}) {
    if (value != 0.0) {
      check.fail(key,
                 "belongs to a rigid contact, and contact.compliance says how this one gives; "
                 "accepted beside it: 0");
    }
  }
}

void check_friction(const Checker& check) {
  if (!check.bearing().contact ||
      !check.sound({"contact.friction.static", "contact.friction.kinetic"}))
    return;
  const FrictionLaw& law = check.bearing().contact->friction;
  if (law.excess < 0.0) {
    check.fail("contact.friction.static",
               "is below contact.friction.kinetic = " + number_text(law.coefficient) +
                   "; accepted: as much or more");
  } else if (law.excess > 0.0 && !check.given("contact.friction.stribeck_speed")) {
    check.fail("contact.friction.stribeck_speed",
               "missing: expected a velocity in m/s, > 0, as static is above kinetic");
  }
}

// Names are one of each; what stands once in a file stands for one bearing.
void check_list(const Checker& check) {
  for (std::size_t k = 0; k < check.index; ++k) {
    if (check.scene.name_of(k) != check.scene.name_of(check.index)) continue;
    check.fail("contact.name",
               "is the name of " + list_element("contact", k) + " too; accepted: one of its own");
  }
  if (check.scene.auxiliary.size() < 2 || !check.bearing().contact) return;
  for (const char* key : {"contact.compression_time", "contact.expansion_time"}) {
    const Contact& c = *check.bearing().contact;
    if ((key == std::string("contact.expansion_time") ? c.expansion_time : c.compression_time) ==
        0.0)
      continue;
    check.fail(
        key, "an impact that takes time is known of one contact alone; accepted beside others: 0");
  }
}

}  // namespace

std::vector<Table> bearing_tables() {
  std::vector<Table> all{contact(), friction(), compliance(), stator(), ring_spin(), actuator()};
  all[0].or_list = true;
  all[1].for_key = true;
  return all;
}

void check_bearing(const Checker& check) {
  check_ring(check);
  if (check.bearing().actuator) check_actuator(check, *check.bearing().actuator);
  check_contact_shapes(check);
  check_compliance(check);
  check_friction(check);
  check_gap_at_start(check);
  check_list(check);
}

}  // namespace rotorub::scene
