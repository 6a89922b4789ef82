// The rows of [run] and [rotor].

#include "native_model/scene/schema.h"

namespace rotorub::scene {
namespace {

constexpr std::string_view kAuto = "auto";
constexpr std::string_view kByDimensions = "by `diameter`, `thickness`";

RotorGeometry& geometry(Scene& scene) {
  if (!scene.rotor.geometry) scene.rotor.geometry.emplace();
  return *scene.rotor.geometry;
}

template <auto Member>
Key shaft(std::string_view name, const Quantity& quantity, std::string_view range,
          std::string_view fallback, std::string_view meaning) {
  return key<&Rotor::geometry, Member>(name, quantity, range, fallback, meaning)
      .in(Form::kGeometry);
}

// A number, or "auto".
Key modes() {
  Key key = shaft<&RotorGeometry::modes>("modes", kPure, "in [1, 1000]", "by `max_frequency`",
                                         "bending modes kept in each plane; it or `max_frequency`; "
                                         "`auto`: as few as `modes_tolerance` allows");
  key.words = {kAuto};
  key.store = [](void* object, const Value& value) {
    auto& shaft = static_cast<Rotor*>(object)->geometry;
    if (!shaft) shaft.emplace();
    shaft->auto_modes = value.text == kAuto;
    if (!shaft->auto_modes) shaft->modes = value.whole;
  };
  return key;
}

Table run() {
  return {
      "run",
      "How long, how finely and what to write.",
      "the defaults",
      [](Scene& scene) -> void* { return &scene.run; },
      {key<&Run::end>("end", kTime, "> 0", kStandard, "end of the run, which starts at 0"),
       key<&Run::step>("step", kTime, "> 0", kStandard, "step of `midpoint` and of MuJoCo"),
       word<&Run::integrator>("integrator", {"event", "midpoint", "verlet", "euler"}, kStandard,
                              "of the native engine"),
       key<&Run::output_step>("output_step", kTime, "> 0", "`end` / 1000",
                              "spacing of the rows of the series"),
       key<&Run::output_times>("output_times", kTime, ">= 0", "none",
                               "further exact times of rows, in any order, each at most `end`")}};
}

Table rotor() {
  return {
      "rotor",
      "The shaft, in one of two forms: its geometry (the keys here and the tables section, disc, "
      "bearing), or its modes ([rotor.modal]).",
      "refused",
      [](Scene& scene) -> void* { return &scene.rotor; },
      {key<&Rotor::speed>("speed", kSpin, "", kStandard,
                          "spin speed at t = 0, positive about +z; held without [drive]"),
       shaft<&RotorGeometry::length>("length", kLength, "> 0", kRequired, "of the shaft, from 0"),
       shaft<&RotorGeometry::E>("E", kPressure, "> 0", kRequired, "Young's modulus"),
       shaft<&RotorGeometry::nu>("nu", kPure, "in (-1, 0.5]",
                                 "0.3; with [rotor.torsion] it or `G` is required",
                                 "Poisson's ratio; not beside `G`"),
       shaft<&RotorGeometry::G>("G", kPressure, "> 0", "`E` / (2 (1 + `nu`))",
                                "shear modulus; not beside `nu`"),
       shaft<&RotorGeometry::rho>("rho", kDensity, "> 0", kRequired, "density"), modes(),
       shaft<&RotorGeometry::modes_tolerance>(
           "modes_tolerance", kPure, "in (0, 1)", kStandard,
           "with `modes = \"auto\"`: how far effective mass at the contact and static flexibility "
           "at contact, bearings and forces may be off those of all modes of the mesh, as a share"),
       shaft<&RotorGeometry::max_frequency>("max_frequency", kSpin, "> 0", "by `modes`",
                                            "keeps the bending modes up to this frequency at rest"),
       shaft<&RotorGeometry::damping_ratio>("damping_ratio", kPure, ">= 0", kStandard,
                                            "external damping of each bending mode"),
       shaft<&RotorGeometry::internal_damping_ratio>(
           "internal_damping_ratio", kPure, ">= 0", kStandard,
           "damping of each bending mode that turns with the shaft")}};
}

Table section() {
  return Table{
      "rotor.section",
      "Pieces of the shaft; together they cover 0 to `length` without gap or overlap.",
      "refused in the geometry form",
      [](Scene& scene) -> void* { return &geometry(scene).sections.emplace_back(); },
      {key<&ShaftSection::from>("from", kLength, ">= 0", kRequired, "first station"),
       key<&ShaftSection::to>("to", kLength, "> 0", kRequired, "last station"),
       key<&ShaftSection::diameter>("diameter", kLength, "> 0", kRequired, "outer diameter"),
       key<&ShaftSection::inner_diameter>("inner_diameter", kLength, ">= 0", kStandard,
                                          "bore, below `diameter`"),
       key<&ShaftSection::end_diameter>(
           "end_diameter", kLength, "> 0", "`diameter`",
           "of a cone: the outer diameter at `to`, `diameter` that at `from`"),
       key<&ShaftSection::end_inner_diameter>("end_inner_diameter", kLength, ">= 0",
                                              "`inner_diameter`",
                                              "the bore at `to`, below `end_diameter`")}}
      .as_list()
      .in(Form::kGeometry);
}

Table disc() {
  return Table{
      "rotor.disc",
      "Rigid discs on the shaft.",
      "none",
      [](Scene& scene) -> void* { return &geometry(scene).discs.emplace_back(); },
      {key<&Disc::z>("z", kLength, ">= 0", kRequired, "along the shaft").or_called("station"),
       key<&Disc::mass>("mass", kMass, ">= 0", kByDimensions, ""),
       key<&Disc::Jt>("Jt", kInertia, ">= 0", kByDimensions, "moment of inertia about a diameter"),
       key<&Disc::Jp>("Jp", kInertia, ">= 0", kByDimensions,
                      "moment of inertia about the shaft, at most 2 `Jt`"),
       key<&Disc::diameter>("diameter", kLength, "> 0", "the three are given",
                            "of a solid disc, whose `mass`, `Jt` and `Jp` follow"),
       key<&Disc::inner_diameter>("inner_diameter", kLength, ">= 0", "0",
                                  "its bore, below `diameter`: the shaft's part is the shaft's"),
       key<&Disc::thickness>("thickness", kLength, "> 0", "the three are given",
                             "along the shaft; needed with `diameter`"),
       key<&Disc::rho>("rho", kDensity, "> 0", "`rotor.rho`", "of the disc with a `diameter`"),
       key<&Disc::eccentricity>("eccentricity", kLength, ">= 0", kStandard,
                                "of the centre of mass"),
       key<&Disc::unbalance>("unbalance", kStaticMoment, ">= 0", "by `eccentricity`",
                             "mass times eccentricity, in its place"),
       key<&Disc::balance_grade>("balance_grade", kPure, "", "by `eccentricity`",
                                 "of ISO 21940-11 in its place, as \"G 2.5\": an eccentricity of "
                                 "2.5 mm/s over `balance_speed`"),
       key<&Disc::balance_speed>("balance_speed", kSpin, "> 0", "`rotor.speed`",
                                 "of `balance_grade`, the fastest in service"),
       key<&Disc::phase>("phase", kAngle, "", kStandard,
                         "of the eccentricity, from the rotor's own x axis")}}
      .as_list()
      .in(Form::kGeometry);
}

Table bearing() {
  return Table{
      "rotor.bearing",
      "Linear bearings between shaft and base, as springs and dashpots, or by the eight "
      "coefficients of an oil film.",
      "none",
      [](Scene& scene) -> void* { return &geometry(scene).bearings.emplace_back(); },
      {key<&ShaftBearing::z>("z", kLength, ">= 0", kRequired, "along the shaft")
           .or_called("station"),
       planes<&ShaftBearing::stiffness>("stiffness", kStiffness, ">= 0", "by `table_kxx`", ""),
       planes<&ShaftBearing::damping>("damping", kDamping, ">= 0", kStandard, ""),
       key<&ShaftBearing::cross_stiffness>(
           "cross_stiffness", kStiffness, "", kStandard,
           "[k_xy, k_yx], across the planes: -k_xy y on x, -k_yx x on y"),
       key<&ShaftBearing::cross_damping>("cross_damping", kDamping, "", kStandard,
                                         "[c_xy, c_yx], alike"),
       key<&ShaftBearing::offset>("offset", kLength, "", kStandard,
                                  "where it stands off the line of the others: its alignment"),
       key<&ShaftBearing::table_speed>(
           "table_speed", kSpin, "", "`stiffness` and the others at every speed",
           "ascending, two or more: the coefficients follow the speed, by a smooth curve "
           "through the points, held beyond the ends"),
       key<&ShaftBearing::table_kxx>("table_kxx", kStiffness, "", "needed with `table_speed`",
                                     "one for each speed"),
       key<&ShaftBearing::table_kxy>("table_kxy", kStiffness, "", "0", "alike"),
       key<&ShaftBearing::table_kyx>("table_kyx", kStiffness, "", "0", "alike"),
       key<&ShaftBearing::table_kyy>("table_kyy", kStiffness, "", "`table_kxx`", "alike"),
       key<&ShaftBearing::table_cxx>("table_cxx", kDamping, "", "0", "alike"),
       key<&ShaftBearing::table_cxy>("table_cxy", kDamping, "", "0", "alike"),
       key<&ShaftBearing::table_cyx>("table_cyx", kDamping, "", "0", "alike"),
       key<&ShaftBearing::table_cyy>("table_cyy", kDamping, "", "`table_cxx`", "alike")}}
      .as_list()
      .in(Form::kGeometry);
}

Table modal() {
  return Table{
      "rotor.modal",
      "The shaft by its bending modes, each scaled to 1 at the contact station. Lists of one "
      "length, one value a mode; the plane y may differ (`mass_y`, ...).",
      "the geometry form",
      [](Scene& scene) -> void* { return &scene.rotor.modal.emplace(); },
      {key<&RotorModal::mass>("mass", kMass, "> 0", kRequired, ""),
       key<&RotorModal::mass_y>("mass_y", kMass, "> 0", "`mass`", "in the plane y"),
       key<&RotorModal::stiffness>("stiffness", kStiffness, ">= 0", kRequired, ""),
       key<&RotorModal::stiffness_y>("stiffness_y", kStiffness, ">= 0", "`stiffness`",
                                     "in the plane y"),
       key<&RotorModal::damping>("damping", kDamping, ">= 0", "0", "external"),
       key<&RotorModal::damping_y>("damping_y", kDamping, ">= 0", "`damping`",
                                   "external, in the plane y"),
       key<&RotorModal::internal_damping>("internal_damping", kDamping, ">= 0", "0",
                                          "turns with the shaft"),
       key<&RotorModal::gyroscopic>("gyroscopic", kMass, "", "0",
                                    "g: the force -Omega g vy on x, +Omega g vx on y"),
       key<&RotorModal::inertia>("inertia", kInertia, ">= 0", kStandard,
                                 "of the rigid spin; required with [drive]")}}
      .in(Form::kModal);
}

Table torsion() {
  return {
      "rotor.torsion",
      "Elastic torsion. Geometry form: how many modes. Modal form: lists of one length, one value "
      "a mode, each mode scaled to 1 at the contact station.",
      "rigid spin only",
      [](Scene& scene) -> void* { return &scene.rotor.torsion.emplace(); },
      {key<&Torsion::modes>("modes", kPure, "in [1, 1000]", kRequired, "torsion modes kept")
           .in(Form::kGeometry),
       key<&Torsion::damping_ratio>("damping_ratio", kPure, ">= 0", "`rotor.damping_ratio`",
                                    "of each torsion mode")
           .in(Form::kGeometry),
       key<&Torsion::inertia>("inertia", kInertia, "> 0", kRequired, "").in(Form::kModal),
       key<&Torsion::stiffness>("stiffness", kAngularStiffness, "> 0", kRequired, "")
           .in(Form::kModal),
       key<&Torsion::damping>("damping", kAngularDamping, ">= 0", "0", "").in(Form::kModal),
       key<&Torsion::drive_shape>("drive_shape", kPure, "", "0", "value of each mode at the motor")
           .in(Form::kModal)}};
}

}  // namespace

std::vector<Table> rotor_tables() {
  return {run(), rotor(), section(), disc(), bearing(), modal(), torsion()};
}

}  // namespace rotorub::scene
