#include "native_model/scene/shaft_bearing.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "native_model/numerics/monotone_cubic.h"
#include "native_model/scene/reading.h"
#include "native_model/scene/schema.h"

namespace rotorub::scene {
namespace {

struct TableKey {
  const char* name;
  std::vector<double> ShaftBearing::*list;
};
constexpr TableKey kTableKeys[] = {
    {".table_kxx", &ShaftBearing::table_kxx}, {".table_kxy", &ShaftBearing::table_kxy},
    {".table_kyx", &ShaftBearing::table_kyx}, {".table_kyy", &ShaftBearing::table_kyy},
    {".table_cxx", &ShaftBearing::table_cxx}, {".table_cxy", &ShaftBearing::table_cxy},
    {".table_cyx", &ShaftBearing::table_cyx}, {".table_cyy", &ShaftBearing::table_cyy}};

// The bearing with the table that follows from its journal, if it has one; exact at `speed`, rad/s.
ShaftBearing tabled(ShaftBearing bearing, double speed) {
  if (!bearing.journal || !bearing.journal->sound()) return bearing;
  bearing.table_speed.clear();
  for (const TableKey& key : kTableKeys) (bearing.*key.list).clear();
  for (const FilmPoint& point : film_points(*bearing.journal, {speed, -speed})) {
    bearing.table_speed.push_back(point.speed);
    for (std::size_t k = 0; k < point.coefficients.size(); ++k)
      (bearing.*kTableKeys[k].list).push_back(point.coefficients[k]);
  }
  return bearing;
}

void check_table(const Reading& check, const ShaftBearing& bearing) {
  if (!check.given(".table_kxx")) {
    check.fail(".table_kxx", "missing: expected a list of stiffnesses in N/m, one for each speed");
  }
  if (!check.sound({".table_speed"})) return;
  check.abscissae(".table_speed", bearing.table_speed, "two speeds");
  for (const TableKey& key : kTableKeys) {
    check.list_length(key.name, bearing.table_speed.size(), "speed of table_speed");
  }
}

bool sound(const ShaftBearing& bearing) {
  const std::size_t n = bearing.table_speed.size();
  const bool ascends = std::adjacent_find(bearing.table_speed.begin(), bearing.table_speed.end(),
                                          std::greater_equal<>()) == bearing.table_speed.end();
  return n >= 2 && ascends &&
         std::all_of(std::begin(kTableKeys), std::end(kTableKeys), [&](const TableKey& key) {
           return (bearing.*key.list).empty() || (bearing.*key.list).size() == n;
         });
}

// Coefficients in N/m and N s/m, in the order of coefficient_lists.
std::array<double, 8> coefficients_at(const ShaftBearing& bearing, double speed) {
  const auto lists = coefficient_lists(bearing);
  std::array<double, 8> all{};
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!lists[k].empty()) all[k] = MonotoneCubic(bearing.table_speed, lists[k]).value(speed);
  }
  return all;
}

}  // namespace

Table shaft_bearing_table() {
  return Table{
      "rotor.bearing",
      "Linear bearings between shaft and base: F_x = -k_xx x - k_xy y - c_xx x' - c_xy y', and F_y "
      "alike. `table_kxx` ... have one value per `table_speed`, interpolated by a monotone cubic "
      "and constant beyond the ends.",
      "none",
      [](Scene& scene) -> void* { return &geometry_of(scene).bearings.emplace_back(); },
      {key<&ShaftBearing::z>("z", kLength, ">= 0", kRequired, "axial position")
           .or_called("station"),
       planes<&ShaftBearing::stiffness>("stiffness", kStiffness, ">= 0", "by `table_kxx`",
                                        "stiffness"),
       planes<&ShaftBearing::damping>("damping", kDamping, ">= 0", kStandard, "damping"),
       key<&ShaftBearing::cross_stiffness>("cross_stiffness", kStiffness, "", kStandard,
                                           "[k_xy, k_yx]"),
       key<&ShaftBearing::cross_damping>("cross_damping", kDamping, "", kStandard, "[c_xy, c_yx]"),
       key<&ShaftBearing::offset>("offset", kLength, "", kStandard,
                                  "distance from the other bearings' line"),
       key<&ShaftBearing::table_speed>("table_speed", kSpin, "", "constant coefficients",
                                       "ascending speeds, two or more"),
       key<&ShaftBearing::table_kxx>("table_kxx", kStiffness, "", "needed with `table_speed`",
                                     "coefficients"),
       key<&ShaftBearing::table_kxy>("table_kxy", kStiffness, "", "0", "coefficients"),
       key<&ShaftBearing::table_kyx>("table_kyx", kStiffness, "", "0", "coefficients"),
       key<&ShaftBearing::table_kyy>("table_kyy", kStiffness, "", "`table_kxx`", "coefficients"),
       key<&ShaftBearing::table_cxx>("table_cxx", kDamping, "", "0", "coefficients"),
       key<&ShaftBearing::table_cxy>("table_cxy", kDamping, "", "0", "coefficients"),
       key<&ShaftBearing::table_cyx>("table_cyx", kDamping, "", "0", "coefficients"),
       key<&ShaftBearing::table_cyy>("table_cyy", kDamping, "", "`table_cxx`", "coefficients")}}
      .as_list()
      .in(Form::kGeometry);
}

Table pedestal_table() {
  return Table{
      "rotor.bearing.pedestal",
      "A body between bearing and base, without weight.",
      "the base carries the bearing",
      [](Scene& scene) -> void* { return &geometry_of(scene).bearings.back().pedestal.emplace(); },
      {key<&Pedestal::mass>("mass", kMass, "> 0", kRequired, "mass"),
       planes<&Pedestal::stiffness>("stiffness", kStiffness, "> 0", kRequired,
                                    "stiffness to the base"),
       planes<&Pedestal::damping>("damping", kDamping, ">= 0", kStandard, "damping to the base")}}
      .in(Form::kGeometry);
}

Table journal_table() {
  return Table{
      "rotor.bearing.journal",
      "A plain journal bearing, by its coefficients at rest under `load`.",
      "springs and dampers, or tables",
      [](Scene& scene) -> void* { return &geometry_of(scene).bearings.back().journal.emplace(); },
      {key<&JournalBearing::diameter>("diameter", kLength, "> 0", kRequired, "of the journal"),
       key<&JournalBearing::length>("length", kLength, "> 0", kRequired, "axial length"),
       key<&JournalBearing::clearance>("clearance", kLength, "> 0", kRequired, "radial clearance"),
       key<&JournalBearing::viscosity>("viscosity", kViscosity, "> 0", kRequired,
                                       "oil at working temperature"),
       key<&JournalBearing::load>("load", kForce, "> 0", kRequired, "static force on the film"),
       key<&JournalBearing::load_angle>("load_angle", kAngle, "", "-90 deg", "from x towards y"),
       word<&JournalBearing::theory>(
           "theory", {"finite", "short"}, kStandard,
           "`finite`: whole equation; `short`: Ocvirk's solution, for length / diameter < 0.5")}}
      .in(Form::kGeometry);
}

void check_bearings(Reading& check, const RotorGeometry& shaft) {
  for (std::size_t i = 0; i < shaft.bearings.size(); ++i) {
    check.at = list_element("rotor.bearing", i);
    check.station(".z", shaft.bearings[i].z);
    for (const char* key : {".stiffness", ".damping", ".cross_stiffness", ".cross_damping"}) {
      check.excludes(key, ".journal");
      check.excludes(key, ".table_speed");
    }
    check.excludes(".table_speed", ".journal");
    if (check.given(".pedestal") && shaft.internal_damping_ratio > 0.0) {
      check.fail(".pedestal",
                 "rotor.internal_damping_ratio damps whole modes in the rotating frame, but a "
                 "pedestal does not turn; remove one of them");
    }
    if (check.given(".table_speed")) {
      check_table(check, shaft.bearings[i]);
      continue;
    }
    for (const TableKey& key : kTableKeys) {
      if (check.given(key.name)) check.fail(key.name, "needs `table_speed`");
    }
    if (!check.given(".stiffness") && !check.given(".journal")) {
      check.missing(".stiffness", "; or give tables over `table_speed` or a `journal` instead");
    }
  }
}

std::array<std::vector<double>, 8> coefficient_lists(const ShaftBearing& bearing) {
  std::array<std::vector<double>, 8> lists;
  for (std::size_t k = 0; k < lists.size(); ++k) lists[k] = bearing.*kTableKeys[k].list;
  if (lists[3].empty()) lists[3] = lists[0];
  if (lists[7].empty()) lists[7] = lists[4];
  return lists;
}

PlanePair stiffness_at(const ShaftBearing& any, double speed) {
  const ShaftBearing bearing = tabled(any, speed);
  if (!bearing.follows_speed() || !sound(bearing)) return bearing.stiffness;
  const auto c = coefficients_at(bearing, speed);
  return {std::max(0.0, c[0]), std::max(0.0, c[3])};
}

void complete_bearings(Rotor& rotor) {
  for (ShaftBearing& bearing : rotor.geometry->bearings) {
    if (!bearing.follows_speed()) continue;
    bearing = tabled(std::move(bearing), rotor.speed);
    const auto c = coefficients_at(bearing, rotor.speed);
    bearing.stiffness = stiffness_at(bearing, rotor.speed);
    bearing.damping = {std::max(0.0, c[4]), std::max(0.0, c[7])};
    bearing.cross_stiffness = {c[1], c[2]};
    bearing.cross_damping = {c[5], c[6]};
  }
}

}  // namespace rotorub::scene
