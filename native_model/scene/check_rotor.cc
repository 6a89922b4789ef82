// Cross-checks of [rotor].

#include <algorithm>
#include <cmath>

#include "native_model/scene/checker.h"
#include "native_model/scene/disc.h"
#include "native_model/scene/shaft_bearing.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

// Sections meet within this part of the length: stations are often rounded decimals.
constexpr double kSectionTolerance = 1e-9;
// Thinner than this part of the length no beam's eigenvalues can be found, or only in minutes.
constexpr double kThinnest = 1e-6;

std::string metres(double z) { return std::to_string(z) + " m"; }

// Sections in the order of the file cover 0 to length.
void check_sections(const Checker& check, const RotorGeometry& shaft) {
  if (!check.sound({"rotor.section"})) return;
  if (shaft.sections.empty()) {
    check.fail("rotor.section", "missing: [[rotor.section]] from 0 to rotor.length");
    return;
  }
  bool sound = check.sound({"rotor.length"});
  for (std::size_t i = 0; i < shaft.sections.size(); ++i) {
    const std::string path = list_element("rotor.section", i);
    const ShaftSection& section = shaft.sections[i];
    if (check.sound({path + ".diameter", path + ".inner_diameter"}) &&
        section.inner_diameter >= section.diameter) {
      check.fail(path + ".inner_diameter",
                 "must be below the outer diameter, " + metres(section.diameter));
    }
    const double end = section.end_diameter.value_or(section.diameter);
    if (section.tapered() &&
        check.sound({path + ".diameter", path + ".inner_diameter", path + ".end_diameter",
                     path + ".end_inner_diameter"}) &&
        section.end_inner_diameter.value_or(section.inner_diameter) >= end) {
      check.fail(path + (section.end_inner_diameter ? ".end_inner_diameter" : ".end_diameter"),
                 "the bore at `to` must be below the outer diameter there, " + metres(end));
    }
    const bool begins = section.diameter >= kThinnest * shaft.length;
    const std::string thinner = path + (begins ? ".end_diameter" : ".diameter");
    if (check.sound({thinner, "rotor.length"}) &&
        (begins ? end : section.diameter) < kThinnest * shaft.length) {
      check.fail(thinner, "too thin for a shaft: expected at least a millionth of rotor.length = " +
                              metres(shaft.length));
    }
    if (!check.sound({path + ".from", path + ".to"})) {
      sound = false;
    } else if (section.to <= section.from) {
      check.fail(path + ".to", "must be beyond `from`, " + metres(section.from));
      sound = false;
    }
  }
  if (!sound) return;

  const double slack = kSectionTolerance * shaft.length;
  double covered = 0.0;
  for (std::size_t i = 0; i < shaft.sections.size(); ++i) {
    const ShaftSection& section = shaft.sections[i];
    if (std::abs(section.from - covered) > slack) {
      check.fail(list_element("rotor.section", i) + ".from",
                 "the sections must cover 0 to rotor.length in order, without gap or overlap: "
                 "expected " +
                     metres(covered) + ", got " + metres(section.from));
    }
    covered = section.to;
  }
  if (std::abs(covered - shaft.length) > slack) {
    check.fail(list_element("rotor.section", shaft.sections.size() - 1) + ".to",
               "the sections must cover 0 to rotor.length: expected " + metres(shaft.length) +
                   ", got " + metres(covered));
  }
}

void check_geometry(const Checker& check, const RotorGeometry& shaft) {
  const Record& record = check.record;
  check_sections(check, shaft);
  check_discs(check, shaft);
  check_bearings(check, shaft);
  if (record.given("rotor.modes") && record.given("rotor.max_frequency")) {
    check.fail("rotor.max_frequency", "give `modes` or `max_frequency`, not both");
  }
  if (!record.given("rotor.modes") && !record.given("rotor.max_frequency")) {
    check.fail("rotor.modes",
               "missing: expected `modes` (a whole number >= 1, or \"auto\") or `max_frequency`");
  }
  if (record.given("rotor.modes_tolerance") && !shaft.auto_modes && record.sound({"rotor.modes"})) {
    check.fail("rotor.modes_tolerance", "belongs to modes = \"auto\"");
  }
  if (record.given("rotor.nu") && record.given("rotor.G")) {
    check.fail("rotor.G", "give `nu` or `G`, not both");
  }
  if (check.scene.rotor.torsion && !record.given("rotor.nu") && !record.given("rotor.G")) {
    check.fail("rotor.nu", "missing: torsion needs `nu` (in (-1, 0.5]) or `G` (in Pa)");
  }
}

void check_modal(const Checker& check, const RotorModal& modal) {
  if (const auto modes = check.bending_modes()) {
    const auto same = [&](const char* name, const std::vector<double>& list) {
      check.list_length(std::string("rotor.modal.") + name, list, *modes,
                        "mode (rotor.modal.mass has " + std::to_string(*modes) + ")");
    };
    same("mass_y", modal.mass_y);
    same("stiffness", modal.stiffness);
    same("stiffness_y", modal.stiffness_y);
    same("damping", modal.damping);
    same("damping_y", modal.damping_y);
    same("internal_damping", modal.internal_damping);
    same("gyroscopic", modal.gyroscopic);
  }
  if (check.scene.drive && check.sound({"rotor.modal.inertia"}) && modal.inertia <= 0.0) {
    check.fail("rotor.modal.inertia",
               "with [drive] the spin is free and needs an inertia in kg m^2, > 0");
  }
}

void check_modal_torsion(const Checker& check, const Torsion& torsion) {
  const auto modes = check.torsion_modes();
  if (!modes) return;
  const auto same = [&](const char* name, const std::vector<double>& list) {
    check.list_length(std::string("rotor.torsion.") + name, list, *modes,
                      "torsion mode (rotor.torsion.inertia has " + std::to_string(*modes) + ")");
  };
  same("stiffness", torsion.stiffness);
  same("damping", torsion.damping);
  same("drive_shape", torsion.drive_shape);
}

}  // namespace

void check_rotor(const Checker& check) {
  const Rotor& rotor = check.scene.rotor;
  if (rotor.geometry && rotor.modal) return;  // already refused
  if (rotor.geometry) check_geometry(check, *rotor.geometry);
  if (rotor.modal) check_modal(check, *rotor.modal);
  if (rotor.modal && rotor.torsion) check_modal_torsion(check, *rotor.torsion);
}

}  // namespace rotorub::scene
