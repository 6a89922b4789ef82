// The rows of [run] and [rotor].

#include "native_model/scene/schema.h"

namespace rotorub::scene {
namespace {

constexpr double kMostModes = 1000;
constexpr std::string_view kAuto = "auto";
constexpr std::string_view kByDimensions = "by `diameter`, `thickness`";

RotorGeometry& geometry(Scene& scene) {
  if (!scene.rotor.geometry) scene.rotor.geometry.emplace();
  return *scene.rotor.geometry;
}

template <auto Member>
Key shaft(std::string_view name, const Quantity& quantity, std::string_view meaning) {
  return key<&Rotor::geometry, Member>(name, quantity, meaning).in(Form::kGeometry);
}

// A number, or "auto".
Key modes() {
  Key key = shaft<&RotorGeometry::modes>(
      "modes", kPure,
      "bending modes kept in each plane; it or `max_frequency`; `auto`: as few as "
      "`modes_tolerance` allows");
  key.words = {kAuto};
  key.store = [](void* object, const Value& value) {
    auto& shaft = static_cast<Rotor*>(object)->geometry;
    if (!shaft) shaft.emplace();
    shaft->auto_modes = value.text == kAuto;
    if (!shaft->auto_modes) shaft->modes = value.whole;
  };
  return key.between(1, kMostModes).otherwise("by `max_frequency`");
}

Table run() {
  return {"run",
          false,
          Form::kEither,
          "How long, how finely and what to write.",
          "the defaults",
          [](Scene& scene) -> void* { return &scene.run; },
          {key<&Run::end>("end", kTime, "end of the run, which starts at 0").above(0).optional(),
           key<&Run::step>("step", kTime, "step of `midpoint` and of MuJoCo").above(0).optional(),
           word<&Run::integrator>("integrator", {"event", "midpoint", "verlet", "euler"},
                                  "of the native engine")
               .optional(),
           key<&Run::output_step>("output_step", kTime, "spacing of the rows of the series")
               .above(0)
               .otherwise("`end` / 1000"),
           key<&Run::output_times>("output_times", kTime,
                                   "further exact times of rows, in any order, each at most `end`")
               .at_least(0)
               .otherwise("none")}};
}

Table rotor() {
  return {
      "rotor",
      false,
      Form::kEither,
      "The shaft, in one of two forms: its geometry (the keys here and the tables section, disc, "
      "bearing), or its modes ([rotor.modal]).",
      "refused",
      [](Scene& scene) -> void* { return &scene.rotor; },
      {key<&Rotor::speed>("speed", kSpin,
                          "spin speed at t = 0, positive about +z; held without [drive]")
           .optional(),
       shaft<&RotorGeometry::length>("length", kLength, "of the shaft, from 0").above(0),
       shaft<&RotorGeometry::E>("E", kPressure, "Young's modulus").above(0),
       shaft<&RotorGeometry::nu>("nu", kPure, "Poisson's ratio; not beside `G`")
           .above(-1)
           .between(-1, 0.5)
           .otherwise("0.3; with [rotor.torsion] it or `G` is required"),
       shaft<&RotorGeometry::G>("G", kPressure, "shear modulus; not beside `nu`")
           .above(0)
           .otherwise("`E` / (2 (1 + `nu`))"),
       shaft<&RotorGeometry::rho>("rho", kDensity, "density").above(0), modes(),
       shaft<&RotorGeometry::modes_tolerance>(
           "modes_tolerance", kPure,
           "with `modes = \"auto\"`: how far effective mass at the contact and static flexibility "
           "at "
           "contact, bearings and forces may be off those of all modes of the mesh, as a share")
           .above(0)
           .below(1)
           .optional(),
       shaft<&RotorGeometry::max_frequency>("max_frequency", kSpin,
                                            "keeps the bending modes up to this frequency at rest")
           .above(0)
           .otherwise("by `modes`"),
       shaft<&RotorGeometry::damping_ratio>("damping_ratio", kPure,
                                            "external damping of each bending mode")
           .at_least(0)
           .optional(),
       shaft<&RotorGeometry::internal_damping_ratio>(
           "internal_damping_ratio", kPure,
           "damping of each bending mode that turns with the shaft")
           .at_least(0)
           .optional()}};
}

Table section() {
  return {"rotor.section",
          true,
          Form::kGeometry,
          "Pieces of the shaft; together they cover 0 to `length` without gap or overlap.",
          "refused in the geometry form",
          [](Scene& scene) -> void* { return &geometry(scene).sections.emplace_back(); },
          {key<&ShaftSection::from>("from", kLength, "first station").at_least(0),
           key<&ShaftSection::to>("to", kLength, "last station").above(0),
           key<&ShaftSection::diameter>("diameter", kLength, "outer diameter").above(0),
           key<&ShaftSection::inner_diameter>("inner_diameter", kLength, "bore, below `diameter`")
               .at_least(0)
               .optional(),
           key<&ShaftSection::end_diameter>(
               "end_diameter", kLength,
               "of a cone: the outer diameter at `to`, `diameter` that at `from`")
               .above(0)
               .otherwise("`diameter`"),
           key<&ShaftSection::end_inner_diameter>("end_inner_diameter", kLength,
                                                  "the bore at `to`, below `end_diameter`")
               .at_least(0)
               .otherwise("`inner_diameter`")}};
}

Table disc() {
  return {
      "rotor.disc",
      true,
      Form::kGeometry,
      "Rigid discs on the shaft.",
      "none",
      [](Scene& scene) -> void* { return &geometry(scene).discs.emplace_back(); },
      {key<&Disc::z>("z", kLength, "along the shaft").or_called("station").at_least(0),
       key<&Disc::mass>("mass", kMass, "").at_least(0).otherwise(kByDimensions),
       key<&Disc::Jt>("Jt", kInertia, "moment of inertia about a diameter")
           .at_least(0)
           .otherwise(kByDimensions),
       key<&Disc::Jp>("Jp", kInertia, "moment of inertia about the shaft, at most 2 `Jt`")
           .at_least(0)
           .otherwise(kByDimensions),
       key<&Disc::diameter>("diameter", kLength,
                            "of a solid disc, whose `mass`, `Jt` and `Jp` follow")
           .above(0)
           .otherwise("the three are given"),
       key<&Disc::inner_diameter>("inner_diameter", kLength,
                                  "its bore, below `diameter`: the shaft's part is the shaft's")
           .at_least(0)
           .otherwise("0"),
       key<&Disc::thickness>("thickness", kLength, "along the shaft; needed with `diameter`")
           .above(0)
           .otherwise("the three are given"),
       key<&Disc::rho>("rho", kDensity, "of the disc with a `diameter`")
           .above(0)
           .otherwise("`rotor.rho`"),
       key<&Disc::eccentricity>("eccentricity", kLength, "of the centre of mass")
           .at_least(0)
           .optional(),
       key<&Disc::unbalance>("unbalance", kStaticMoment, "mass times eccentricity, in its place")
           .at_least(0)
           .otherwise("by `eccentricity`"),
       key<&Disc::balance_grade>(
           "balance_grade", kPure,
           "of ISO 21940-11 in its place, as \"G 2.5\": an eccentricity of 2.5 mm/s over "
           "`balance_speed`")
           .otherwise("by `eccentricity`"),
       key<&Disc::balance_speed>("balance_speed", kSpin,
                                 "of `balance_grade`, the fastest in service")
           .above(0)
           .otherwise("`rotor.speed`"),
       key<&Disc::phase>("phase", kAngle, "of the eccentricity, from the rotor's own x axis")
           .optional()}};
}

Table bearing() {
  return {"rotor.bearing",
          true,
          Form::kGeometry,
          "Linear bearings between shaft and base, as springs and dashpots, or by the eight "
          "coefficients of an oil film.",
          "none",
          [](Scene& scene) -> void* { return &geometry(scene).bearings.emplace_back(); },
          {key<&ShaftBearing::z>("z", kLength, "along the shaft").or_called("station").at_least(0),
           planes<&ShaftBearing::stiffness>("stiffness", kStiffness, "")
               .at_least(0)
               .otherwise("by `table_kxx`"),
           planes<&ShaftBearing::damping>("damping", kDamping, "").at_least(0).optional(),
           key<&ShaftBearing::cross_stiffness>(
               "cross_stiffness", kStiffness,
               "[k_xy, k_yx], across the planes: -k_xy y on x, -k_yx x on y")
               .optional(),
           key<&ShaftBearing::cross_damping>("cross_damping", kDamping, "[c_xy, c_yx], alike")
               .optional(),
           key<&ShaftBearing::offset>("offset", kLength,
                                      "where it stands off the line of the others: its alignment")
               .optional(),
           key<&ShaftBearing::table_speed>(
               "table_speed", kSpin,
               "ascending, two or more: the coefficients follow the speed, by a smooth "
               "curve through the points, held beyond the ends")
               .otherwise("`stiffness` and the others at every speed"),
           key<&ShaftBearing::table_kxx>("table_kxx", kStiffness, "one for each speed")
               .otherwise("needed with `table_speed`"),
           key<&ShaftBearing::table_kxy>("table_kxy", kStiffness, "alike").otherwise("0"),
           key<&ShaftBearing::table_kyx>("table_kyx", kStiffness, "alike").otherwise("0"),
           key<&ShaftBearing::table_kyy>("table_kyy", kStiffness, "alike").otherwise("`table_kxx`"),
           key<&ShaftBearing::table_cxx>("table_cxx", kDamping, "alike").otherwise("0"),
           key<&ShaftBearing::table_cxy>("table_cxy", kDamping, "alike").otherwise("0"),
           key<&ShaftBearing::table_cyx>("table_cyx", kDamping, "alike").otherwise("0"),
           key<&ShaftBearing::table_cyy>("table_cyy", kDamping, "alike").otherwise("`table_cxx`")}};
}

Table modal() {
  return {
      "rotor.modal",
      false,
      Form::kModal,
      "The shaft by its bending modes, each scaled to 1 at the contact station. Lists of one "
      "length, one value a mode; the plane y may differ (`mass_y`, ...).",
      "the geometry form",
      [](Scene& scene) -> void* { return &scene.rotor.modal.emplace(); },
      {key<&RotorModal::mass>("mass", kMass, "").above(0),
       key<&RotorModal::mass_y>("mass_y", kMass, "in the plane y").above(0).otherwise("`mass`"),
       key<&RotorModal::stiffness>("stiffness", kStiffness, "").at_least(0),
       key<&RotorModal::stiffness_y>("stiffness_y", kStiffness, "in the plane y")
           .at_least(0)
           .otherwise("`stiffness`"),
       key<&RotorModal::damping>("damping", kDamping, "external").at_least(0).otherwise("0"),
       key<&RotorModal::damping_y>("damping_y", kDamping, "external, in the plane y")
           .at_least(0)
           .otherwise("`damping`"),
       key<&RotorModal::internal_damping>("internal_damping", kDamping, "turns with the shaft")
           .at_least(0)
           .otherwise("0"),
       key<&RotorModal::gyroscopic>("gyroscopic", kMass,
                                    "g: the force -Omega g vy on x, +Omega g vx on y")
           .otherwise("0"),
       key<&RotorModal::inertia>("inertia", kInertia, "of the rigid spin; required with [drive]")
           .at_least(0)
           .optional()}};
}

Table torsion() {
  return {
      "rotor.torsion",
      false,
      Form::kEither,
      "Elastic torsion. Geometry form: how many modes. Modal form: lists of one length, one value "
      "a mode, each mode scaled to 1 at the contact station.",
      "rigid spin only",
      [](Scene& scene) -> void* { return &scene.rotor.torsion.emplace(); },
      {key<&Torsion::modes>("modes", kPure, "torsion modes kept")
           .between(1, kMostModes)
           .in(Form::kGeometry),
       key<&Torsion::damping_ratio>("damping_ratio", kPure, "of each torsion mode")
           .at_least(0)
           .in(Form::kGeometry)
           .otherwise("`rotor.damping_ratio`"),
       key<&Torsion::inertia>("inertia", kInertia, "").above(0).in(Form::kModal),
       key<&Torsion::stiffness>("stiffness", kAngularStiffness, "").above(0).in(Form::kModal),
       key<&Torsion::damping>("damping", kAngularDamping, "")
           .at_least(0)
           .in(Form::kModal)
           .otherwise("0"),
       key<&Torsion::drive_shape>("drive_shape", kPure, "value of each mode at the motor")
           .in(Form::kModal)
           .otherwise("0")}};
}

}  // namespace

std::vector<Table> rotor_tables() {
  return {run(), rotor(), section(), disc(), bearing(), modal(), torsion()};
}

}  // namespace rotorub::scene
