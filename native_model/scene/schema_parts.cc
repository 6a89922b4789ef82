// The rows of everything around the rotor but its auxiliary bearing: drive, forces, start, MuJoCo.

#include "native_model/scene/contact_models.h"
#include "native_model/scene/schema.h"

namespace rotorub::scene {
namespace {

Table drive() {
  return {
      "drive",
      false,
      Form::kEither,
      "The motor: its torque acts on the spin.",
      "the spin speed is held at `rotor.speed`",
      [](Scene& scene) -> void* { return &scene.drive.emplace(); },
      {word<&Drive::kind>(
           "kind", {"free", "linear", "kloss", "table", "speed_controlled"},
           "no torque; T = `gain` (`speed` - Omega); asynchronous motor, T = 2 T_b s "
           "s_b/(s^2 + s_b^2), s = 1 - Omega/`synchronous_speed`; a table; PI control of the speed "
           "at the motor, T = `gain` (ref - Omega) + `integral_gain` (integral of ref - Omega), "
           "sum and integral each within `torque_limit`, ref from `rotor.speed` to `speed` at "
           "`acceleration`"),
       key<&Drive::gain>("gain", kAngularDamping, "torque per speed")
           .at_least(0)
           .of({"linear", "speed_controlled"}),
       key<&Drive::speed>("speed", kSpin, "at which the torque is 0; the speed to be kept")
           .of({"linear", "speed_controlled"}),
       key<&Drive::integral_gain>("integral_gain", kAngularStiffness,
                                  "torque per angle left behind")
           .at_least(0)
           .of({"speed_controlled"})
           .optional(),
       key<&Drive::torque_limit>("torque_limit", kTorque, "of the torque's size")
           .above(0)
           .of({"speed_controlled"})
           .otherwise("none"),
       key<&Drive::acceleration>("acceleration", kAngularAcceleration,
                                 "of the reference, up or down, from `rotor.speed` at t = 0")
           .above(0)
           .of({"speed_controlled"})
           .otherwise("`speed` at once"),
       key<&Drive::breakdown_torque>("breakdown_torque", kTorque, "T_b").above(0).of({"kloss"}),
       key<&Drive::breakdown_slip>("breakdown_slip", kPure, "s_b").above(0).of({"kloss"}),
       key<&Drive::synchronous_speed>("synchronous_speed", kSpin, "at which the torque is 0")
           .above(0)
           .of({"kloss"}),
       key<&Drive::table_speed>("table_speed", kSpin, "ascending, two or more").of({"table"}),
       key<&Drive::table_torque>("table_torque", kTorque, "one for each speed").of({"table"}),
       key<&Drive::station>("station", kLength, "of the motor")
           .or_called("z")
           .at_least(0)
           .in(Form::kGeometry)
           .optional(),
       key<&Drive::inertia>("inertia", kInertia, "of the motor's rotor")
           .at_least(0)
           .in(Form::kGeometry)
           .optional()}};
}

Table force() {
  return {
      "force",
      true,
      Form::kEither,
      "Forces on the rotor. Each acts for `on` <= t < `off` and rises linearly over `ramp`.",
      "none",
      [](Scene& scene) -> void* { return &scene.forces.emplace_back(); },
      {word<&Force::kind>(
           "kind", {"rotating", "constant", "synchronous", "chirp", "pulse", "unbalance"},
           "`amplitude` (cos(w t + `phase`), sin(w t + `phase`)) with t absolute and w "
           "= `frequency`; `vector`; turning with the spin at phi + `phase`, an outer force "
           "without a torque on the spin; turning ever faster, from `frequency` at `on` to "
           "`frequency_end` at `off`; a half-sine of `vector` from `on` to `off`; a mass that is "
           "out of the axis from `on` for ever, as a disc's eccentricity: a blade is lost"),
       key<&Force::amplitude>("amplitude", kForce, "size; turned by pi if negative")
           .of({"rotating", "synchronous", "chirp"}),
       key<&Force::frequency>("frequency", kSpin, "negative: backward").of({"rotating", "chirp"}),
       key<&Force::frequency_end>("frequency_end", kSpin, "at `off`, linear in time").of({"chirp"}),
       key<&Force::static_moment>("static_moment", kStaticMoment, "mass times eccentricity")
           .at_least(0)
           .of({"unbalance"}),
       key<&Force::phase>("phase", kAngle,
                          "direction from the x axis at t = 0, of a chirp at `on`; from the "
                          "rotor's own x axis where it turns with the spin")
           .of({"rotating", "synchronous", "chirp", "unbalance"})
           .optional(),
       key<&Force::vector>("vector", kForce, "fixed in space; of a pulse its peak")
           .of({"constant", "pulse"}),
       key<&Force::on>("on", kTime, "acts from here").optional(),
       key<&Force::off>("off", kTime, "acts up to here, not before `on`; chirp and pulse need it")
           .of({"rotating", "constant", "synchronous", "chirp", "pulse"})
           .otherwise("never"),
       key<&Force::ramp>("ramp", kTime, "rise from 0 after `on`")
           .at_least(0)
           .of({"rotating", "constant", "synchronous", "chirp"})
           .optional(),
       key<&Force::shape>("shape", kPure, "value of each bending mode at the station")
           .in(Form::kModal)
           .otherwise("all 1"),
       key<&Force::station>("station", kLength, "along the shaft")
           .or_called("z")
           .at_least(0)
           .in(Form::kGeometry)}};
}

Table magnetic_bearing() {
  return {"magnetic_bearing",
          false,
          Form::kEither,
          "Adds the force + `negative_stiffness` times the deflection at its station, and what its "
          "`control` does; its excitation is a [[force]] at the same station.",
          "none",
          [](Scene& scene) -> void* { return &scene.magnetic_bearing.emplace(); },
          {key<&MagneticBearing::negative_stiffness>("negative_stiffness", kStiffness, "its size")
               .at_least(0),
           key<&MagneticBearing::shape>("shape", kPure, "value of each bending mode at the station")
               .in(Form::kModal)
               .otherwise("all 1"),
           key<&MagneticBearing::station>("station", kLength, "along the shaft")
               .or_called("z")
               .at_least(0)
               .in(Form::kGeometry)}};
}

Table bearing_control() {
  return {"magnetic_bearing.control",
          false,
          Form::kEither,
          "The bearing's own feedback, on each of x and y by the deflection r at its station: the "
          "current i = -(`proportional` r + `integral` times the integral of r + `derivative` r'), "
          "within the limit, and its force "
          "`force_per_current` i (A magnetic bearing that holds the rotor). Needs "
          "[magnetic_bearing].",
          "the bearing holds nothing",
          [](Scene& scene) -> void* {
            if (!scene.magnetic_bearing) scene.magnetic_bearing.emplace();
            return &scene.magnetic_bearing->control.emplace();
          },
          {key<&BearingControl::force_per_current>("force_per_current", kForcePerCurrent, "k_i")
               .above(0),
           key<&BearingControl::proportional>("proportional", kCurrentPerLength, "P").at_least(0),
           key<&BearingControl::integral>(
               "integral", kCurrentPerLengthTime,
               "I; at the limit it takes back what is cut off; needs `proportional`")
               .at_least(0)
               .optional(),
           key<&BearingControl::derivative>("derivative", kCurrentPerVelocity, "D")
               .at_least(0)
               .optional(),
           key<&BearingControl::current_limit>("current_limit", kCurrent,
                                               "of the current's size on each axis")
               .above(0)
               .otherwise("none"),
           key<&BearingControl::fails_at>("fails_at", kTime,
                                          "from here on neither current nor negative stiffness")
               .at_least(0)
               .otherwise("never")}};
}

Table gravity() {
  return {"gravity",
          false,
          Form::kEither,
          "A constant acceleration in the plane of bending.",
          "none",
          [](Scene& scene) -> void* { return &scene.gravity.emplace(); },
          {key<&Gravity::acceleration>("acceleration", kAcceleration, "as of a falling body"),
           key<&Gravity::participation>("participation", kMass,
                                        "load of each bending mode per unit acceleration")
               .in(Form::kModal)
               .otherwise("the modal mass")}};
}

// A key of [initial] that is kept with the first ring, where there is one.
template <auto Member>
Key start_of_ring(std::string_view name, const Quantity& quantity, std::string_view meaning) {
  Key result = key<Member>(name, quantity, meaning).optional();
  result.store = [](void* object, const Value& value) {
    if (auto& ring = static_cast<Scene*>(object)->first().stator) (*ring).*Member = value.pair;
  };
  return result;
}

Table initial() {
  const std::string_view modal = "bending modes, one value a mode";
  return {
      "initial",
      false,
      Form::kEither,
      "State at t = 0. The spin speed is `rotor.speed`.",
      "all 0",
      [](Scene& scene) -> void* { return &scene; },
      {key<&Scene::initial, &Initial::steady>(
           "steady", kPure,
           "on the steady free orbit; not beside x, y, vx, vy, stator and "
           "stator_velocity (A steady start)")
           .optional(),
       key<&Scene::initial, &Initial::x>("x", kLength, modal).otherwise("0"),
       key<&Scene::initial, &Initial::y>("y", kLength, modal).otherwise("0"),
       key<&Scene::initial, &Initial::vx>("vx", kVelocity, modal).otherwise("0"),
       key<&Scene::initial, &Initial::vy>("vy", kVelocity, modal).otherwise("0"),
       key<&Scene::initial, &Initial::spin_angle>("spin_angle", kAngle, "of the rotor's own x axis")
           .optional(),
       key<&Scene::initial, &Initial::torsion>("torsion", kAngle, "torsion modes").otherwise("0"),
       key<&Scene::initial, &Initial::torsion_speed>("torsion_speed", kSpin, "torsion modes")
           .otherwise("0"),
       start_of_ring<&Stator::position>("stator", kLength, "position of the ring; needs [stator]"),
       start_of_ring<&Stator::velocity>("stator_velocity", kVelocity,
                                        "of the ring; needs [stator]")}};
}

Table mujoco() {
  return {"mujoco",
          false,
          Form::kEither,
          "How MuJoCo runs the scene.",
          "the defaults",
          [](Scene& scene) -> void* { return &scene.mujoco; },
          {word<&Mujoco::rotor>(
               "rotor", {"modal", "segments"},
               "modal chain, in the native model's coordinates; chain of rigid segments "
               "(geometry form only)")
               .optional(),
           key<&Mujoco::segments>("segments", kPure,
                                  "pieces that the segment rotor's shaft is cut into")
               .between(2, 200)
               .optional(),
           word<&Mujoco::contact>(
               "contact", contact_words<std::vector<std::string_view>>(),
               "rigid impulses by the plugin; MuJoCo's soft normal contact with "
               "Coulomb friction by the plugin; MuJoCo's own friction cone; the same with its "
               "normal reference corrected for sliding, so that it obeys Coulomb's law")
               .optional(),
           word<&Mujoco::integrator>("integrator", {"euler", "implicit", "rk4"}, "of MuJoCo")
               .optional(),
           word<&Mujoco::solver>("solver", {"newton", "cg", "pgs"}, "MuJoCo's constraint solver")
               .optional(),
           key<&Mujoco::solref_stiffness>("solref_stiffness", kRateSquared,
                                          "K of the soft contact (direct solref)")
               .above(0)
               .otherwise("chosen from the step, and for the cones from the scene's speeds"),
           key<&Mujoco::solref_damping>("solref_damping", kRate,
                                        "B of the soft contact (direct solref)")
               .above(0)
               .otherwise("that which bounces with contact.restitution"),
           key<&Mujoco::friction_reference>("friction_reference", kRate,
                                            "B_t, with which the friction rows of contact model "
                                            "cone brake the slip (solreffriction of MuJoCo 2.3.7 "
                                            "and later)")
               .above(0)
               .otherwise("that of the normal row, as MuJoCo has it"),
           key<&Mujoco::shadow>("shadow", kPure,
                                "the native model runs alongside, step by step: its gap, forces "
                                "and position are user sensors, and a ghost shows it "
                                "(plugin/README.md)")
               .optional()}};
}

}  // namespace

std::vector<Table> part_tables() {
  std::vector<Table> all{drive(), force(), magnetic_bearing(), bearing_control()};
  for (Table& table : bearing_tables()) all.push_back(std::move(table));
  for (Table& table : control_tables()) all.push_back(std::move(table));
  for (Table table : {gravity(), initial(), mujoco()}) all.push_back(std::move(table));
  return all;
}

}  // namespace rotorub::scene
