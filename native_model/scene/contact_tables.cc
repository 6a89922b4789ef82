// [contact] of an auxiliary bearing and the laws below it: rows and cross-checks.

#include <algorithm>

#include "native_model/scene/reading.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

Table contact() {
  return {
      "contact",
      "Contact of rotor and ring. For several use `[[contact]]`, each followed by its own "
      "`[contact.stator]`, `[contact.actuator]`, `[contact.controller]` instead of `[stator]` and "
      "so on.",
      "no contact",
      [](Scene& scene) -> void* {
        scene.auxiliary.back().contact.emplace();
        return &scene.auxiliary.back();
      },
      {key<&AuxiliaryBearing::contact, &Contact::radius>("radius", kLength, "> 0", kRequired,
                                                         "rotor radius at the contact"),
       key<&AuxiliaryBearing::contact, &Contact::clearance>("clearance", kLength, "> 0", kRequired,
                                                            "radial clearance delta_0"),
       key<&AuxiliaryBearing::contact, &Contact::friction, &FrictionLaw::coefficient>(
           "friction", kPure, ">= 0", kRequired, "mu, or the table `[contact.friction]`"),
       key<&AuxiliaryBearing::contact, &Contact::restitution>(
           "restitution", kPure, "in [0, 1]", "required, unless the compliance has a damping",
           "normal restitution"),
       key<&AuxiliaryBearing::contact, &Contact::tangential_restitution>(
           "tangential_restitution", kPure, "in [0, 1]", kStandard, "tangential restitution"),
       key<&AuxiliaryBearing::contact, &Contact::compression_time>(
           "compression_time", kTime, ">= 0", kStandard,
           "tau_C, duration of an impact's compression"),
       key<&AuxiliaryBearing::contact, &Contact::expansion_time>(
           "expansion_time", kTime, ">= 0", kStandard, "tau_E, duration of an impact's expansion"),
       key<&AuxiliaryBearing::contact, &Contact::station>("station", kLength, ">= 0", kRequired,
                                                          "axial position")
           .or_called("z")
           .in(Form::kGeometry),
       key<&AuxiliaryBearing::contact, &Contact::offset>(
           "offset", kLength, "", kStandard, "resting ring's centre from the resting shaft"),
       key<&AuxiliaryBearing::name>("name", kPure, "", "its number, from 1",
                                    "unique name in messages and figures"),
       key<&AuxiliaryBearing::contact, &Contact::shape>(
           "shape", kPure, "", "all 1", "mode values at the station; first contact: 1")
           .in(Form::kModal),
       key<&AuxiliaryBearing::contact, &Contact::torsion_shape>("torsion_shape", kPure, "", "all 1",
                                                                "torsion mode values, likewise")
           .in(Form::kModal)}};
}

Table compliance() {
  return {
      "contact.compliance",
      "Compliant contact: at penetration p the normal force is N = `stiffness` p^`exponent` (1 + a "
      "p'), never below 0. By default a follows from `restitution` "
      "([theory](../../native_model/docs/theory.md#compliant-contact)). A sticking contact is "
      "rigid tangentially.",
      "the contact is rigid",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().contact->compliance.emplace(); },
      {key<&Compliance::stiffness>("stiffness", kContactStiffness, "> 0", kRequired,
                                   "contact stiffness"),
       key<&Compliance::exponent>("exponent", kPure, "in [1, 2]", kStandard,
                                  "1: line contact; 1.5: Hertz's point contact"),
       key<&Compliance::hunt_crossley>("hunt_crossley", kTimePerLength, ">= 0",
                                       "from `restitution`", "damping coefficient a"),
       key<&Compliance::damping>(
           "damping", kDamping, ">= 0", "none",
           "linear damping c instead of a: N = `stiffness` p + c p'; needs `exponent` = 1")}};
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
      "Friction that depends on the slip v: mu = kinetic + (static - kinetic) exp(-(v / "
      "stribeck_speed)^2) + viscous |v|.",
      "mu is constant",
      [](Scene& scene) -> void* { return &scene.auxiliary.back().contact->friction; },
      {key<&FrictionLaw::coefficient>("kinetic", kPure, ">= 0", kRequired, "mu in fast sliding"),
       rest,
       key<&FrictionLaw::stribeck_speed>("stribeck_speed", kVelocity, "> 0",
                                         "required if static > kinetic",
                                         "slip at which 63 % of the difference is lost"),
       key<&FrictionLaw::viscous>("viscous", kSlowness, ">= 0", kStandard,
                                  "increase of mu with the slip")}};
}

// Mode values at the station. They must be 1 at the first contact, where the modes are scaled.
void check_contact_shapes(const Reading& check) {
  if (!check.bearing().contact) return;
  const Contact& contact = *check.bearing().contact;
  const auto one = [&](const char* key, const std::vector<double>& shape,
                       std::optional<std::size_t> modes, const char* of) {
    check.list_length(key, modes, of);
    if (check.index > 0 || std::ranges::all_of(shape, [](double s) { return s == 1.0; })) return;
    check.fail(key,
               "must be 1 for each mode, because the modes are scaled to 1 at the first contact; "
               "scale the modes in this way, or list another contact first");
  };
  one("contact.shape", contact.shape, check.bending_modes(), "bending mode");
  one("contact.torsion_shape", contact.torsion_shape, check.torsion_modes(), "torsion mode");
}

void check_compliance(const Reading& check) {
  if (!check.bearing().contact) return;
  const Contact& contact = *check.bearing().contact;
  const bool damped = contact.compliance && !contact.compliance->by_restitution();
  if (!check.given("contact.restitution") && !damped) {
    check.missing("contact.restitution");
  }
  if (!contact.compliance) return;
  check.excludes("contact.compliance.damping", "contact.compliance.hunt_crossley");
  if (contact.compliance->damping && contact.compliance->exponent != 1.0) {
    check.fail(
        "contact.compliance.damping",
        "needs exponent = 1; with another exponent give hunt_crossley or restitution instead");
  }
  for (const auto& [key, value] :
       {std::pair("contact.compression_time", contact.compression_time),
        std::pair("contact.expansion_time", contact.expansion_time),
        std::pair("contact.tangential_restitution", contact.tangential_restitution)}) {
    if (value != 0.0) {
      check.fail(key, "is for rigid contacts only; set 0, or remove contact.compliance");
    }
  }
}

void check_friction(const Reading& check) {
  if (!check.bearing().contact ||
      !check.sound({"contact.friction.static", "contact.friction.kinetic"}))
    return;
  const FrictionLaw& law = check.bearing().contact->friction;
  if (law.excess < 0.0) {
    check.fail("contact.friction.static",
               "is below contact.friction.kinetic = " + number_text(law.coefficient) +
                   "; give as much or more");
  } else if (law.excess > 0.0 && !check.given("contact.friction.stribeck_speed")) {
    check.missing("contact.friction.stribeck_speed", ", because static is above kinetic");
  }
}

// Names must be unique. With several contacts, impacts must have zero duration.
void check_list(const Reading& check) {
  for (std::size_t k = 0; k < check.index; ++k) {
    if (check.scene.name_of(k) != check.scene.name_of(check.index)) continue;
    check.fail("contact.name", "is the name of " + list_element("contact", k) +
                                   " too; give each contact a name of its own");
  }
  if (check.scene.auxiliary.size() < 2 || !check.bearing().contact) return;
  const Contact& contact = *check.bearing().contact;
  for (const auto& [key, time] : {std::pair("contact.compression_time", contact.compression_time),
                                  std::pair("contact.expansion_time", contact.expansion_time)}) {
    if (time == 0.0) continue;
    check.fail(key,
               "impacts of finite duration are supported only with a single contact; set 0, or "
               "remove the other contacts");
  }
}

}  // namespace

std::vector<Table> contact_tables() {
  std::vector<Table> all{contact(), friction(), compliance()};
  all[0].or_list = true;
  all[1].for_key = true;
  return all;
}

void check_contact(const Reading& check) {
  check_contact_shapes(check);
  check_compliance(check);
  check_friction(check);
  check_list(check);
}

}  // namespace rotorub::scene
