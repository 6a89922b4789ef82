// [contact] of an auxiliary bearing and the laws below it: rows and cross-checks.

#include <algorithm>

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
                                                             "radius of the rotor at the contact"),
           key<&AuxiliaryBearing::contact, &Contact::clearance>("clearance", kLength, "> 0",
                                                                kRequired, "delta_0, radial"),
           key<&AuxiliaryBearing::contact, &Contact::friction, &FrictionLaw::coefficient>(
               "friction", kPure, ">= 0", kRequired, "mu; or the table `[contact.friction]`"),
           key<&AuxiliaryBearing::contact, &Contact::restitution>(
               "restitution", kPure, "in [0, 1]",
               "required, unless `contact.compliance` gives `hunt_crossley` or `damping`",
               "eps_N, normal restitution"),
           key<&AuxiliaryBearing::contact, &Contact::tangential_restitution>(
               "tangential_restitution", kPure, "in [0, 1]", kStandard,
               "eps_T, tangential restitution"),
           key<&AuxiliaryBearing::contact, &Contact::compression_time>(
               "compression_time", kTime, ">= 0", kStandard,
               "tau_C, time that the compression of an impact takes"),
           key<&AuxiliaryBearing::contact, &Contact::expansion_time>(
               "expansion_time", kTime, ">= 0", kStandard, "tau_E, time that its expansion takes"),
           key<&AuxiliaryBearing::contact, &Contact::station>("station", kLength, ">= 0", kRequired,
                                                              "place along the shaft")
               .or_called("z")
               .in(Form::kGeometry),
           key<&AuxiliaryBearing::contact, &Contact::offset>(
               "offset", kLength, "", kStandard,
               "of the ring's middle at rest from the line of the shaft at rest"),
           key<&AuxiliaryBearing::name>("name", kPure, "", "its number, from 1",
                                        "name of this bearing in messages and pictures; unique"),
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
      "Makes the contact compliant: at the penetration p the normal force is N = `stiffness` "
      "p^`exponent` (1 + a p') while that is positive, and 0 otherwise. `hunt_crossley` sets a. "
      "If neither `hunt_crossley` nor `damping` is given, each touch has its own a, with which "
      "two free masses that touch at the speed v rebound with the `restitution` e of the contact: "
      "ln[(1 + a v)/(1 - a e v)] = a v (1 + e). An e below 0.01 counts as 0.01, and a v below 0.1 "
      "mm/s as 0.1 mm/s. Friction follows Coulomb's law with this N; a contact that sticks does "
      "not yield along the surface. A contact that is closed at the start was not struck: unless "
      "`hunt_crossley` is given, its a is 0 until it opens.",
      "the contact is rigid",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().contact->compliance.emplace(); },
      {key<&Compliance::stiffness>("stiffness", kContactStiffness, "> 0", kRequired,
                                   "stiffness k of the contact"),
       key<&Compliance::exponent>(
           "exponent", kPure, "in [1, 2]", kStandard,
           "exponent n of the penetration: 1 for a line contact, 1.5 for Hertz's point contact"),
       key<&Compliance::hunt_crossley>("hunt_crossley", kTimePerLength, ">= 0",
                                       "from `restitution`",
                                       "coefficient a of the damping by Hunt and Crossley"),
       key<&Compliance::damping>(
           "damping", kDamping, ">= 0", "none",
           "coefficient c of a linear damper, N = k p + c p', which replaces a; only with "
           "`exponent` = 1")}};
}

// `static` is stored as its excess over `kinetic`, whose row comes first.
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
       key<&FrictionLaw::stribeck_speed>(
           "stribeck_speed", kVelocity, "> 0", "needed where static > kinetic",
           "slip at which 63 % of what static has beyond kinetic is gone"),
       key<&FrictionLaw::viscous>("viscous", kSlowness, ">= 0", kStandard,
                                  "by how much mu grows with the slip")}};
}

// Mode values at the station. They must be 1 at the first contact, where the modes are scaled.
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

// Names must be unique. With several contacts, impacts must have zero duration.
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

std::vector<Table> contact_tables() {
  std::vector<Table> all{contact(), friction(), compliance()};
  all[0].or_list = true;
  all[1].for_key = true;
  return all;
}

void check_contact(const Checker& check) {
  check_contact_shapes(check);
  check_compliance(check);
  check_friction(check);
  check_gap_at_start(check);
  check_list(check);
}

}  // namespace rotorub::scene
