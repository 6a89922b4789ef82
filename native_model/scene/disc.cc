#include "native_model/scene/disc.h"

#include <charconv>
#include <cmath>
#include <numbers>
#include <string>

#include "native_model/scene/reading.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

// Jp <= 2 Jt holds for every rigid body; the tolerance allows for rounded data sheets.
constexpr double kInertiaTolerance = 0.01;
// Jp = mass eccentricity^2 describes a point mass, and is accepted whatever the last digits.
constexpr double kPointMassTolerance = 1e-9;

constexpr std::string_view kByDimensions = "by `diameter`, `thickness`";

// The disc with mass, Jt, Jp and eccentricity in numbers. `speed`: of the rotor, rad/s.
Disc in_numbers(Disc disc, double rho, double speed) {
  if (disc.diameter && disc.thickness) {
    const double outer = *disc.diameter, inner = disc.inner_diameter.value_or(0.0),
                 h = *disc.thickness;
    disc.mass =
        disc.rho.value_or(rho) * std::numbers::pi / 4.0 * (outer * outer - inner * inner) * h;
    disc.Jp = disc.mass / 8.0 * (outer * outer + inner * inner);
    disc.Jt = 0.5 * disc.Jp + disc.mass * h * h / 12.0;
  }
  if (disc.unbalance && disc.mass > 0.0) disc.eccentricity = *disc.unbalance / disc.mass;
  if (!disc.balance_grade.empty()) {
    const double turns = disc.balance_speed.value_or(std::abs(speed));
    if (turns > 0.0) disc.eccentricity = balance_quality(disc.balance_grade).value_or(0.0) / turns;
  }
  return disc;
}

// The disc must be given completely by its numbers or completely by its dimensions.
void check_size(const Reading& check, const Disc& disc) {
  const bool dimensions = check.given(".diameter") || check.given(".thickness");
  for (const char* key : {".mass", ".Jt", ".Jp"}) {
    if (dimensions && check.given(key)) {
      check.fail(key,
                 "follows from `diameter` and `thickness`, which are given too; remove it, or "
                 "remove those two");
    } else if (!dimensions && !check.given(key)) {
      check.missing(key, "; or give the disc's `diameter` and `thickness` instead");
    }
  }
  for (const char* key : {".diameter", ".thickness"}) {
    if (dimensions && !check.given(key)) check.missing(key);
  }
  for (const char* key : {".inner_diameter", ".rho"}) {
    if (!dimensions && check.given(key))
      check.fail(
          key, "belongs to a disc with `diameter` and `thickness`; give both, or remove this key");
  }
  if (disc.diameter && disc.inner_diameter && *disc.inner_diameter >= *disc.diameter) {
    check.fail(".inner_diameter",
               "must be below `diameter`, " + number_text(*disc.diameter) + " m");
  }
}

void check_unbalance(const Reading& check, const Disc& disc, const Disc& whole) {
  const char* first = nullptr;
  for (const char* key : {".eccentricity", ".unbalance", ".balance_grade"}) {
    if (!check.given(key)) continue;
    if (first != nullptr) {
      check.fail(key, std::string("sets the same as `") + (first + 1) +
                          "`, which is also given; remove one of them");
    }
    first = first == nullptr ? key : first;
  }
  if (disc.unbalance && *disc.unbalance > 0.0 && whole.mass == 0.0 && check.sound({".mass"})) {
    check.fail(".unbalance", "needs a mass > 0");
  }
  if (!check.given(".balance_grade")) {
    if (check.given(".balance_speed"))
      check.fail(".balance_speed", "belongs to `balance_grade`, which is missing");
    return;
  }
  if (!balance_quality(disc.balance_grade)) {
    check.fail(".balance_grade", "expected a grade of ISO 21940-11 in mm/s, as \"G 2.5\", got '" +
                                     printable(disc.balance_grade) + "'");
  } else if (!disc.balance_speed && check.scene.rotor.speed == 0.0 &&
             check.sound({"rotor.speed"})) {
    check.fail(".balance_grade",
               "is an eccentricity times a speed, and rotor.speed is 0; give `balance_speed`");
  }
}

void check_inertia(const Reading& check, const Disc& disc) {
  if (check.sound({".Jt", ".Jp"}) && disc.Jp > 2.0 * disc.Jt * (1.0 + kInertiaTolerance)) {
    check.fail(".Jp", "no rigid body has Jp > 2 Jt; a thin disc has Jp = 2 Jt");
  }
  // If the spin is free, a smaller Jp makes the mass matrix indefinite and creates energy.
  const double least = disc.mass * disc.eccentricity * disc.eccentricity;
  if (check.scene.drive && check.sound({".mass", ".Jp", ".eccentricity"}) &&
      disc.Jp < least * (1.0 - kPointMassTolerance)) {
    check.fail(".Jp",
               "with [drive] the spin is free, and a disc whose mass is out of centre by its "
               "eccentricity has at least mass eccentricity^2 = " +
                   number_text(least) + " kg m^2 about the shaft, got " + number_text(disc.Jp) +
                   " kg m^2");
  }
}

}  // namespace

Table disc_table() {
  return Table{
      "rotor.disc",
      "Rigid discs on the shaft.",
      "none",
      [](Scene& scene) -> void* { return &geometry_of(scene).discs.emplace_back(); },
      {key<&Disc::z>("z", kLength, ">= 0", kRequired, "axial position").or_called("station"),
       key<&Disc::mass>("mass", kMass, ">= 0", kByDimensions, "mass"),
       key<&Disc::Jt>("Jt", kInertia, ">= 0", kByDimensions, "inertia about a diameter"),
       key<&Disc::Jp>("Jp", kInertia, ">= 0", kByDimensions,
                      "inertia about the shaft, at most 2 `Jt`"),
       key<&Disc::diameter>("diameter", kLength, "> 0", "none", "outer diameter"),
       key<&Disc::inner_diameter>("inner_diameter", kLength, ">= 0", "0",
                                  "bore; the disc excludes the shaft"),
       key<&Disc::thickness>("thickness", kLength, "> 0", "none", "axial thickness"),
       key<&Disc::rho>("rho", kDensity, "> 0", "`rotor.rho`", "density, beside `diameter`"),
       key<&Disc::eccentricity>("eccentricity", kLength, ">= 0", kStandard,
                                "centre of mass from the axis"),
       key<&Disc::unbalance>("unbalance", kStaticMoment, ">= 0", "by `eccentricity`",
                             "mass times eccentricity"),
       key<&Disc::balance_grade>("balance_grade", kPure, "", "by `eccentricity`",
                                 "ISO 21940-11: \"G 2.5\" means 2.5 mm/s / `balance_speed`"),
       key<&Disc::balance_speed>("balance_speed", kSpin, "> 0", "`rotor.speed`",
                                 "highest service speed"),
       key<&Disc::phase>("phase", kAngle, "", kStandard, "angle from the rotor's x axis")}}
      .as_list()
      .in(Form::kGeometry);
}

std::optional<double> balance_quality(std::string_view grade) {
  grade = trimmed(grade);
  if (!grade.starts_with('G')) return std::nullopt;
  grade = trimmed(grade.substr(1));
  double value = 0.0;
  const auto [end, fault] = std::from_chars(grade.data(), grade.data() + grade.size(), value);
  if (fault != std::errc() || end != grade.data() + grade.size()) return std::nullopt;
  if (!(value > 0.0) || !std::isfinite(value)) return std::nullopt;
  return value / 1000.0;
}

void check_discs(Reading& check, const RotorGeometry& shaft) {
  for (std::size_t i = 0; i < shaft.discs.size(); ++i) {
    check.at = list_element("rotor.disc", i);
    const Disc whole = in_numbers(shaft.discs[i], shaft.rho, check.scene.rotor.speed);
    check.station(".z", whole.z);
    check_size(check, shaft.discs[i]);
    check_unbalance(check, shaft.discs[i], whole);
    check_inertia(check, whole);
  }
}

void complete_discs(Rotor& rotor) {
  for (Disc& disc : rotor.geometry->discs)
    disc = in_numbers(disc, rotor.geometry->rho, rotor.speed);
}

}  // namespace rotorub::scene
