// [rotor] and the tables below it, except discs and bearings: rows and cross-checks.

#include <cmath>

#include "native_model/scene/reading.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

constexpr std::string_view kAuto = "auto";
// Allowed mismatch between sections, relative to the length: stations are often rounded decimals.
constexpr double kSectionTolerance = 1e-9;
// Least diameter relative to the length. For thinner shafts the eigenvalues cannot be found, or
// only in minutes.
constexpr double kThinnest = 1e-6;

template <auto Member>
Key shaft(std::string_view name, const Quantity& quantity, std::string_view range,
          std::string_view fallback, std::string_view meaning) {
  return key<&Rotor::geometry, Member>(name, quantity, range, fallback, meaning)
      .in(Form::kGeometry);
}

// A number or "auto".
Key modes() {
  Key key = shaft<&RotorGeometry::modes>("modes", kPure, "in [1, 1000]", "by `max_frequency`",
                                         "bending modes per plane");
  key.words = {kAuto};
  key.store = [](void* object, const Value& value) {
    auto& shaft = static_cast<Rotor*>(object)->geometry;
    if (!shaft) shaft.emplace();
    shaft->auto_modes = value.text == kAuto;
    if (!shaft->auto_modes) shaft->modes = value.whole;
  };
  return key;
}

Key theory() {
  return word<&Rotor::geometry, &RotorGeometry::theory>("theory", {"euler-bernoulli", "timoshenko"},
                                                        kStandard,
                                                        "`timoshenko`: with shear deformation")
      .in(Form::kGeometry);
}

Table rotor() {
  return {
      "rotor",
      "The shaft, by its geometry or by [rotor.modal].",
      "refused",
      [](Scene& scene) -> void* { return &scene.rotor; },
      {key<&Rotor::speed>("speed", kSpin, "", kStandard, "spin speed at t = 0"),
       shaft<&RotorGeometry::length>("length", kLength, "> 0", kRequired, "shaft length"),
       shaft<&RotorGeometry::E>("E", kPressure, "> 0", kRequired, "Young's modulus"),
       shaft<&RotorGeometry::nu>("nu", kPure, "in (-1, 0.5]",
                                 "0.3; torsion and shear need it or `G`", "Poisson's ratio"),
       shaft<&RotorGeometry::G>("G", kPressure, "> 0", "`E` / (2 (1 + `nu`))", "shear modulus"),
       shaft<&RotorGeometry::rho>("rho", kDensity, "> 0", kRequired, "density"), theory(),
       shaft<&RotorGeometry::shear_coefficient>("shear_coefficient", kPure, "> 0",
                                                "by Cowper (1966)",
                                                "shear area / area, for `timoshenko`"),
       shaft<&RotorGeometry::axial_force>("axial_force", kForce, "", kStandard, "tension positive"),
       modes(),
       shaft<&RotorGeometry::modes_tolerance>(
           "modes_tolerance", kPure, "in (0, 1)", kStandard,
           "for `auto`: allowed relative error of effective masses and flexibilities"),
       shaft<&RotorGeometry::max_frequency>("max_frequency", kSpin, "> 0", "by `modes`",
                                            "highest bending frequency kept, at rest"),
       shaft<&RotorGeometry::damping_ratio>("damping_ratio", kPure, ">= 0", kStandard,
                                            "external damping of each mode"),
       shaft<&RotorGeometry::internal_damping_ratio>("internal_damping_ratio", kPure, ">= 0",
                                                     kStandard,
                                                     "internal (rotating) damping of each mode")}};
}

Table section() {
  return Table{
      "rotor.section",
      "Sections, from 0 to `length` without gap or overlap.",
      "refused in the geometry form",
      [](Scene& scene) -> void* { return &geometry_of(scene).sections.emplace_back(); },
      {key<&ShaftSection::from>("from", kLength, ">= 0", kRequired, "start"),
       key<&ShaftSection::to>("to", kLength, "> 0", kRequired, "end"),
       key<&ShaftSection::diameter>("diameter", kLength, "> 0", kRequired, "outer diameter"),
       key<&ShaftSection::inner_diameter>("inner_diameter", kLength, ">= 0", kStandard, "bore"),
       key<&ShaftSection::end_diameter>("end_diameter", kLength, "> 0", "`diameter`",
                                        "outer diameter at `to`"),
       key<&ShaftSection::end_inner_diameter>("end_inner_diameter", kLength, ">= 0",
                                              "`inner_diameter`", "bore at `to`")}}
      .as_list()
      .in(Form::kGeometry);
}

Table modal() {
  return Table{
      "rotor.modal",
      "The shaft's bending modes, scaled to 1 at the contact. Lists have one value per mode; `_y` "
      "marks the plane y.",
      "the geometry form",
      [](Scene& scene) -> void* { return &scene.rotor.modal.emplace(); },
      {key<&RotorModal::mass>("mass", kMass, "> 0", kRequired, "modal mass"),
       key<&RotorModal::mass_y>("mass_y", kMass, "> 0", "`mass`", "modal mass in y"),
       key<&RotorModal::stiffness>("stiffness", kStiffness, ">= 0", kRequired, "modal stiffness"),
       key<&RotorModal::stiffness_y>("stiffness_y", kStiffness, ">= 0", "`stiffness`",
                                     "modal stiffness in y"),
       key<&RotorModal::damping>("damping", kDamping, ">= 0", "0", "external damping"),
       key<&RotorModal::damping_y>("damping_y", kDamping, ">= 0", "`damping`",
                                   "external damping in y"),
       key<&RotorModal::internal_damping>("internal_damping", kDamping, ">= 0", "0",
                                          "internal (rotating) damping"),
       key<&RotorModal::gyroscopic>("gyroscopic", kMass, "", "0",
                                    "g: forces -Omega g vy on x, Omega g vx on y"),
       key<&RotorModal::inertia>("inertia", kInertia, ">= 0", kStandard,
                                 "inertia of the spin; required with [drive]")}}
      .in(Form::kModal);
}

Table torsion() {
  return {
      "rotor.torsion",
      "Elastic torsion. Lists have one value per mode, scaled to 1 at the contact.",
      "rigid spin only",
      [](Scene& scene) -> void* { return &scene.rotor.torsion.emplace(); },
      {key<&Torsion::modes>("modes", kPure, "in [1, 1000]", kRequired, "torsion modes kept")
           .in(Form::kGeometry),
       key<&Torsion::damping_ratio>("damping_ratio", kPure, ">= 0", "`rotor.damping_ratio`",
                                    "damping of each mode")
           .in(Form::kGeometry),
       key<&Torsion::inertia>("inertia", kInertia, "> 0", kRequired, "modal inertia")
           .in(Form::kModal),
       key<&Torsion::stiffness>("stiffness", kAngularStiffness, "> 0", kRequired, "modal stiffness")
           .in(Form::kModal),
       key<&Torsion::damping>("damping", kAngularDamping, ">= 0", "0", "modal damping")
           .in(Form::kModal),
       key<&Torsion::drive_shape>("drive_shape", kPure, "", "0", "mode value at the motor")
           .in(Form::kModal)}};
}

std::string metres(double z) { return std::to_string(z) + " m"; }

// Sections in the order of the file cover 0 to length.
void check_sections(Reading& check, const RotorGeometry& shaft) {
  if (!check.sound({"rotor.section"})) return;
  if (shaft.sections.empty()) {
    check.fail("rotor.section",
               "missing: expected tables [[rotor.section]] that cover 0 to rotor.length");
    return;
  }
  bool sound = check.sound({"rotor.length"});
  const double thinnest = kThinnest * shaft.length;
  for (std::size_t i = 0; i < shaft.sections.size(); ++i) {
    check.at = list_element("rotor.section", i);
    const ShaftSection& section = shaft.sections[i];
    if (check.sound({".diameter", ".inner_diameter"}) &&
        section.inner_diameter >= section.diameter) {
      check.fail(".inner_diameter",
                 "must be below the outer diameter, " + metres(section.diameter));
    }
    const double end = section.end_diameter.value_or(section.diameter);
    if (section.tapered() &&
        check.sound({".diameter", ".inner_diameter", ".end_diameter", ".end_inner_diameter"}) &&
        section.end_inner_diameter.value_or(section.inner_diameter) >= end) {
      check.fail(section.end_inner_diameter ? ".end_inner_diameter" : ".end_diameter",
                 "the bore at `to` must be below the outer diameter there, " + metres(end));
    }
    const bool begins = section.diameter >= thinnest;
    const char* thinner = begins ? ".end_diameter" : ".diameter";
    if (check.sound({thinner, "rotor.length"}) && (begins ? end : section.diameter) < thinnest) {
      check.fail(thinner, "too thin for a shaft: expected at least a millionth of rotor.length = " +
                              metres(shaft.length));
    }
    if (!check.sound({".from", ".to"})) {
      sound = false;
    } else if (section.to <= section.from) {
      check.fail(".to", "must be beyond `from`, " + metres(section.from));
      sound = false;
    }
  }
  if (!sound) return;

  const double slack = kSectionTolerance * shaft.length;
  double covered = 0.0;
  for (std::size_t i = 0; i < shaft.sections.size(); ++i) {
    check.at = list_element("rotor.section", i);
    const ShaftSection& section = shaft.sections[i];
    if (std::abs(section.from - covered) > slack) {
      check.fail(
          ".from",
          "the sections must cover 0 to rotor.length in order, without gap or overlap: expected " +
              metres(covered) + ", got " + metres(section.from));
    }
    covered = section.to;
  }
  if (std::abs(covered - shaft.length) > slack) {
    check.fail(".to", "the sections must cover 0 to rotor.length: expected " +
                          metres(shaft.length) + ", got " + metres(covered));
  }
}

void check_geometry(Reading& check, const RotorGeometry& shaft) {
  check_sections(check, shaft);
  check_discs(check, shaft);
  check_bearings(check, shaft);
  if (check.given("rotor.modes") && check.given("rotor.max_frequency")) {
    check.fail("rotor.max_frequency", "give `modes` or `max_frequency`, not both");
  }
  if (!check.given("rotor.modes") && !check.given("rotor.max_frequency")) {
    check.fail("rotor.modes",
               "missing: expected `modes` (a whole number >= 1, or \"auto\") or `max_frequency`");
  }
  if (check.given("rotor.modes_tolerance") && !shaft.auto_modes && check.sound({"rotor.modes"})) {
    check.fail("rotor.modes_tolerance",
               "belongs to modes = \"auto\"; remove it, or set rotor.modes = \"auto\"");
  }
  if (check.given("rotor.nu") && check.given("rotor.G")) {
    check.fail("rotor.G", "give `nu` or `G`, not both");
  }
  const bool sheared = shaft.theory == ShaftTheory::kTimoshenko;
  if ((check.scene.rotor.torsion || sheared) && !check.given("rotor.nu") &&
      !check.given("rotor.G")) {
    check.fail("rotor.nu", std::string("missing: ") + (sheared ? "shear" : "torsion") +
                               " needs `nu` (in (-1, 0.5]) or `G` (in Pa)");
  }
  if (!sheared && check.given("rotor.shear_coefficient") && check.sound({"rotor.theory"})) {
    check.fail(
        "rotor.shear_coefficient",
        "belongs to theory = \"timoshenko\"; remove it, or set rotor.theory = \"timoshenko\"");
  }
}

void check_modal(Reading& check, const RotorModal& modal) {
  check.at = "rotor.modal";
  if (const auto modes = check.bending_modes()) {
    const std::string of = "mode (rotor.modal.mass has " + std::to_string(*modes) + ")";
    for (const char* key : {".mass_y", ".stiffness", ".stiffness_y", ".damping", ".damping_y",
                            ".internal_damping", ".gyroscopic"}) {
      check.list_length(key, modes, of);
    }
  }
  if (check.scene.drive && check.sound({".inertia"}) && modal.inertia <= 0.0) {
    check.fail(".inertia", "with [drive] the spin is free and needs an inertia in kg m^2, > 0");
  }
}

void check_modal_torsion(const Reading& check) {
  const auto modes = check.torsion_modes();
  if (!modes) return;
  const std::string of = "torsion mode (rotor.torsion.inertia has " + std::to_string(*modes) + ")";
  for (const char* key :
       {"rotor.torsion.stiffness", "rotor.torsion.damping", "rotor.torsion.drive_shape"}) {
    check.list_length(key, modes, of);
  }
}

}  // namespace

std::vector<Table> rotor_tables() {
  return {rotor(),         section(),        disc_table(), shaft_bearing_table(),
          journal_table(), pedestal_table(), modal(),      torsion()};
}

void check_rotor(Reading& check) {
  const Rotor& rotor = check.scene.rotor;
  if ((rotor.geometry && rotor.modal) || !check.sound({"rotor"})) return;  // already refused
  if (rotor.geometry) check_geometry(check, *rotor.geometry);
  if (rotor.modal) check_modal(check, *rotor.modal);
  if (rotor.modal && rotor.torsion) check_modal_torsion(check);
}

}  // namespace rotorub::scene
