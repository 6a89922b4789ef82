// The rows of everything around the rotor but its auxiliary bearing: drive, forces, start, MuJoCo.

#include "native_model/scene/contact_models.h"
#include "native_model/scene/schema.h"

namespace rotorub::scene {
namespace {

Table drive() {
  return {"drive",
          "The motor: its torque acts on the spin.",
          "the spin speed is held at `rotor.speed`",
          [](Scene& scene) -> void* { return &scene.drive.emplace(); },
          {word<&Drive::kind>(
               "kind", {"free", "linear", "kloss", "table", "speed_controlled"}, kRequired,
               "no torque; T = `gain` (`speed` - Omega); asynchronous motor, T = 2 T_b s s_b/(s^2 "
               "+ s_b^2), s = 1 - Omega/`synchronous_speed`; a table; PI control of the speed at "
               "the motor, T = `gain` (ref - Omega) + `integral_gain` (integral of ref - Omega), "
               "sum and integral each within `torque_limit`, ref from `rotor.speed` to `speed` at "
               "`acceleration`"),
           key<&Drive::gain>("gain", kAngularDamping, ">= 0", kRequired, "torque per speed",
                             {"linear", "speed_controlled"}),
           key<&Drive::speed>("speed", kSpin, "", kRequired,
                              "at which the torque is 0; the speed to be kept",
                              {"linear", "speed_controlled"}),
           key<&Drive::integral_gain>("integral_gain", kAngularStiffness, ">= 0", kStandard,
                                      "torque per angle left behind", {"speed_controlled"}),
           key<&Drive::torque_limit>("torque_limit", kTorque, "> 0", "none", "of the torque's size",
                                     {"speed_controlled"}),
           key<&Drive::acceleration>("acceleration", kAngularAcceleration, "> 0", "`speed` at once",
                                     "of the reference, up or down, from `rotor.speed` at t = 0",
                                     {"speed_controlled"}),
           key<&Drive::breakdown_torque>("breakdown_torque", kTorque, "> 0", kRequired, "T_b",
                                         {"kloss"}),
           key<&Drive::breakdown_slip>("breakdown_slip", kPure, "> 0", kRequired, "s_b", {"kloss"}),
           key<&Drive::synchronous_speed>("synchronous_speed", kSpin, "> 0", kRequired,
                                          "at which the torque is 0", {"kloss"}),
           key<&Drive::table_speed>("table_speed", kSpin, "", kRequired, "ascending, two or more",
                                    {"table"}),
           key<&Drive::table_torque>("table_torque", kTorque, "", kRequired, "one for each speed",
                                     {"table"}),
           key<&Drive::station>("station", kLength, ">= 0", kStandard, "of the motor")
               .or_called("z")
               .in(Form::kGeometry),
           key<&Drive::inertia>("inertia", kInertia, ">= 0", kStandard, "of the motor's rotor")
               .in(Form::kGeometry)}};
}

Table force() {
  return Table{
      "force",
      "Forces on the rotor. Each acts for `on` <= t < `off` and rises linearly over `ramp`.",
      "none",
      [](Scene& scene) -> void* { return &scene.forces.emplace_back(); },
      {word<&Force::kind>(
           "kind", {"rotating", "constant", "synchronous", "chirp", "pulse", "unbalance"},
           kRequired,
           "`amplitude` (cos(w t + `phase`), sin(w t + `phase`)) with t absolute and w = "
           "`frequency`; `vector`; turning with the spin at phi + `phase`, an outer force without "
           "a torque on the spin; turning ever faster, from `frequency` at `on` to `frequency_end` "
           "at `off`; a half-sine of `vector` from `on` to `off`; a mass that is out of the axis "
           "from `on` for ever, as a disc's eccentricity: a blade is lost"),
       key<&Force::amplitude>("amplitude", kForce, "", kRequired, "size; turned by pi if negative",
                              {"rotating", "synchronous", "chirp"}),
       key<&Force::frequency>("frequency", kSpin, "", kRequired, "negative: backward",
                              {"rotating", "chirp"}),
       key<&Force::frequency_end>("frequency_end", kSpin, "", kRequired, "at `off`, linear in time",
                                  {"chirp"}),
       key<&Force::static_moment>("static_moment", kStaticMoment, ">= 0", kRequired,
                                  "mass times eccentricity", {"unbalance"}),
       key<&Force::phase>("phase", kAngle, "", kStandard,
                          "direction from the x axis at t = 0, of a chirp at `on`; from the "
                          "rotor's own x axis where it turns with the spin",
                          {"rotating", "synchronous", "chirp", "unbalance"}),
       key<&Force::vector>("vector", kForce, "", kRequired, "fixed in space; of a pulse its peak",
                           {"constant", "pulse"}),
       key<&Force::on>("on", kTime, "", kStandard, "acts from here"),
       key<&Force::off>("off", kTime, "", "never",
                        "acts up to here, not before `on`; chirp and pulse need it",
                        {"rotating", "constant", "synchronous", "chirp", "pulse"}),
       key<&Force::ramp>("ramp", kTime, ">= 0", kStandard, "rise from 0 after `on`",
                         {"rotating", "constant", "synchronous", "chirp"}),
       key<&Force::shape>("shape", kPure, "", "all 1", "value of each bending mode at the station")
           .in(Form::kModal),
       key<&Force::station>("station", kLength, ">= 0", kRequired, "along the shaft")
           .or_called("z")
           .in(Form::kGeometry)}}
      .as_list();
}

Table magnetic_bearing() {
  return {"magnetic_bearing",
          "Adds the force + `negative_stiffness` times the deflection at its station, and what its "
          "`control` does; its excitation is a [[force]] at the same station.",
          "none",
          [](Scene& scene) -> void* { return &scene.magnetic_bearing.emplace(); },
          {key<&MagneticBearing::negative_stiffness>("negative_stiffness", kStiffness, ">= 0",
                                                     kRequired, "its size"),
           key<&MagneticBearing::shape>("shape", kPure, "", "all 1",
                                        "value of each bending mode at the station")
               .in(Form::kModal),
           key<&MagneticBearing::station>("station", kLength, ">= 0", kRequired, "along the shaft")
               .or_called("z")
               .in(Form::kGeometry)}};
}

Table bearing_control() {
  return {
      "magnetic_bearing.control",
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
      {key<&BearingControl::force_per_current>("force_per_current", kForcePerCurrent, "> 0",
                                               kRequired, "k_i"),
       key<&BearingControl::proportional>("proportional", kCurrentPerLength, ">= 0", kRequired,
                                          "P"),
       key<&BearingControl::integral>(
           "integral", kCurrentPerLengthTime, ">= 0", kStandard,
           "I; at the limit it takes back what is cut off; needs `proportional`"),
       key<&BearingControl::derivative>("derivative", kCurrentPerVelocity, ">= 0", kStandard, "D"),
       key<&BearingControl::current_limit>("current_limit", kCurrent, "> 0", "none",
                                           "of the current's size on each axis"),
       key<&BearingControl::fails_at>("fails_at", kTime, ">= 0", "never",
                                      "from here on neither current nor negative stiffness")}};
}

Table gravity() {
  return {"gravity",
          "A constant acceleration in the plane of bending.",
          "none",
          [](Scene& scene) -> void* { return &scene.gravity.emplace(); },
          {key<&Gravity::acceleration>("acceleration", kAcceleration, "", kRequired,
                                       "as of a falling body"),
           key<&Gravity::participation>("participation", kMass, "", "the modal mass",
                                        "load of each bending mode per unit acceleration")
               .in(Form::kModal)}};
}

// A key of [initial] that is kept with the first ring, where there is one.
template <auto Member>
Key start_of_ring(std::string_view name, const Quantity& quantity, std::string_view meaning) {
  Key result = key<Member>(name, quantity, "", kStandard, meaning);
  result.store = [](void* object, const Value& value) {
    if (auto& ring = static_cast<Scene*>(object)->first().stator) (*ring).*Member = value.pair;
  };
  return result;
}

Table initial() {
  const std::string_view modal = "bending modes, one value a mode";
  return {
      "initial",
      "State at t = 0. The spin speed is `rotor.speed`.",
      "all 0",
      [](Scene& scene) -> void* { return &scene; },
      {key<&Scene::initial, &Initial::steady>("steady", kPure, "", kStandard,
                                              "on the steady free orbit; not beside x, y, vx, vy, "
                                              "stator and stator_velocity (A steady start)"),
       key<&Scene::initial, &Initial::x>("x", kLength, "", "0", modal),
       key<&Scene::initial, &Initial::y>("y", kLength, "", "0", modal),
       key<&Scene::initial, &Initial::vx>("vx", kVelocity, "", "0", modal),
       key<&Scene::initial, &Initial::vy>("vy", kVelocity, "", "0", modal),
       key<&Scene::initial, &Initial::spin_angle>("spin_angle", kAngle, "", kStandard,
                                                  "of the rotor's own x axis"),
       key<&Scene::initial, &Initial::torsion>("torsion", kAngle, "", "0", "torsion modes"),
       key<&Scene::initial, &Initial::torsion_speed>("torsion_speed", kSpin, "", "0",
                                                     "torsion modes"),
       start_of_ring<&Stator::position>("stator", kLength, "position of the ring; needs [stator]"),
       start_of_ring<&Stator::velocity>("stator_velocity", kVelocity,
                                        "of the ring; needs [stator]")}};
}

Table mujoco() {
  return {
      "mujoco",
      "How MuJoCo runs the scene.",
      "the defaults",
      [](Scene& scene) -> void* { return &scene.mujoco; },
      {word<&Mujoco::rotor>("rotor", {"modal", "segments"}, kStandard,
                            "modal chain, in the native model's coordinates; chain of rigid "
                            "segments (geometry form only)"),
       key<&Mujoco::segments>("segments", kPure, "in [2, 200]", kStandard,
                              "pieces that the segment rotor's shaft is cut into"),
       word<&Mujoco::contact>(
           "contact", contact_words<std::vector<std::string_view>>(), kStandard,
           "rigid impulses by the plugin; MuJoCo's soft normal contact with Coulomb friction by "
           "the plugin; MuJoCo's own friction cone; the same with its normal reference corrected "
           "for sliding, so that it obeys Coulomb's law"),
       word<&Mujoco::integrator>("integrator", {"euler", "implicit", "rk4"}, kStandard,
                                 "of MuJoCo"),
       word<&Mujoco::solver>("solver", {"newton", "cg", "pgs"}, kStandard,
                             "MuJoCo's constraint solver"),
       key<&Mujoco::solref_stiffness>(
           "solref_stiffness", kRateSquared, "> 0",
           "chosen from the step, and for the cones from the scene's speeds",
           "K of the soft contact (direct solref)"),
       key<&Mujoco::solref_damping>("solref_damping", kRate, "> 0",
                                    "that which bounces with contact.restitution",
                                    "B of the soft contact (direct solref)"),
       key<&Mujoco::friction_reference>(
           "friction_reference", kRate, "> 0", "that of the normal row, as MuJoCo has it",
           "B_t, with which the friction rows of contact model cone brake the slip (solreffriction "
           "of MuJoCo 2.3.7 and later)"),
       key<&Mujoco::shadow>("shadow", kPure, "", kStandard,
                            "the native model runs alongside, step by step: its gap, forces and "
                            "position are user sensors, and a ghost shows it (plugin/README.md)")}};
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
