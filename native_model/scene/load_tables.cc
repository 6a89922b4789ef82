// [drive] and [[force]]: rows and cross-checks. ([base] is in base_table.cc, magnetic bearings are
// in magnetic_tables.cc.)

#include "native_model/scene/checker.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"

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
                              "speed at which the torque is 0; the speed to be kept",
                              {"linear", "speed_controlled"}),
           key<&Drive::integral_gain>("integral_gain", kAngularStiffness, ">= 0", kStandard,
                                      "torque per angle by which the motor is behind",
                                      {"speed_controlled"}),
           key<&Drive::torque_limit>("torque_limit", kTorque, "> 0", "none",
                                     "largest size of the torque", {"speed_controlled"}),
           key<&Drive::acceleration>(
               "acceleration", kAngularAcceleration, "> 0", "`speed` at once",
               "how fast the reference changes, up or down, from `rotor.speed` at t = 0",
               {"speed_controlled"}),
           key<&Drive::breakdown_torque>("breakdown_torque", kTorque, "> 0", kRequired,
                                         "T_b, the largest torque", {"kloss"}),
           key<&Drive::breakdown_slip>("breakdown_slip", kPure, "> 0", kRequired,
                                       "s_b, the slip at that torque", {"kloss"}),
           key<&Drive::synchronous_speed>("synchronous_speed", kSpin, "> 0", kRequired,
                                          "speed at which the torque is 0", {"kloss"}),
           key<&Drive::table_speed>("table_speed", kSpin, "", kRequired,
                                    "speeds, ascending, two or more", {"table"}),
           key<&Drive::table_torque>(
               "table_torque", kTorque, "", kRequired,
               "torques, one for each speed; in between a monotone cubic (Fritsch-Carlson: mean "
               "secants as slopes at inner points, secants at the ends), held beyond the ends",
               {"table"}),
           key<&Drive::station>("station", kLength, ">= 0", kStandard,
                                "place of the motor along the shaft")
               .or_called("z")
               .in(Form::kGeometry),
           key<&Drive::inertia>("inertia", kInertia, ">= 0", kStandard,
                                "moment of inertia of the motor's rotor")
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
       key<&Force::amplitude>("amplitude", kForce, "", kRequired,
                              "size of the force; turned by pi if negative",
                              {"rotating", "synchronous", "chirp"}),
       key<&Force::frequency>("frequency", kSpin, "", kRequired,
                              "speed at which the force turns; negative: backward",
                              {"rotating", "chirp"}),
       key<&Force::frequency_end>("frequency_end", kSpin, "", kRequired,
                                  "frequency at `off`; it changes linearly in time", {"chirp"}),
       key<&Force::static_moment>("static_moment", kStaticMoment, ">= 0", kRequired,
                                  "mass times eccentricity", {"unbalance"}),
       key<&Force::phase>("phase", kAngle, "", kStandard,
                          "direction from the x axis at t = 0, of a chirp at `on`; from the "
                          "rotor's own x axis where it turns with the spin",
                          {"rotating", "synchronous", "chirp", "unbalance"}),
       key<&Force::vector>("vector", kForce, "", kRequired,
                           "the force, fixed in space; of a pulse its peak", {"constant", "pulse"}),
       key<&Force::on>("on", kTime, "", kStandard, "time from which it acts"),
       key<&Force::off>("off", kTime, "", "never",
                        "time up to which it acts, not before `on`; chirp and pulse need it",
                        {"rotating", "constant", "synchronous", "chirp", "pulse"}),
       key<&Force::ramp>("ramp", kTime, ">= 0", kStandard,
                         "time in which it rises from 0 after `on`",
                         {"rotating", "constant", "synchronous", "chirp"}),
       key<&Force::shape>("shape", kPure, "", "all 1", "value of each bending mode at the station")
           .in(Form::kModal),
       key<&Force::station>("station", kLength, ">= 0", kRequired, "place along the shaft")
           .or_called("z")
           .in(Form::kGeometry)}}
      .as_list();
}

void check_drive(const Checker& check, const Drive& drive) {
  check.station("drive.station", drive.station);
  if (drive.kind != DriveKind::kTable || !check.given("drive.table_speed") ||
      !check.sound({"drive.table_speed"})) {
    return;
  }
  const std::vector<double>& speed = drive.table_speed;
  if (speed.size() < 2) check.fail("drive.table_speed", "expected two speeds or more");
  check.ascending("drive.table_speed", speed);
  check.list_length("drive.table_torque", drive.table_torque, speed.size(),
                    "speed of drive.table_speed");
}

void check_forces(const Checker& check) {
  const auto modes = check.bending_modes();
  for (std::size_t i = 0; i < check.scene.forces.size(); ++i) {
    const std::string path = list_element("force", i);
    const Force& force = check.scene.forces[i];
    check.station(path + ".station", force.station);
    if (modes) check.list_length(path + ".shape", force.shape, *modes, "bending mode");
    if (check.sound({path + ".on", path + ".off"}) && force.off < force.on) {
      check.fail(path + ".off", "must not be before `on` = " + number_text(force.on) + " s");
    }
    const bool passes = force.kind == ForceKind::kChirp || force.kind == ForceKind::kPulse;
    if (!passes || !check.sound({path + ".kind", path + ".on", path + ".off"})) continue;
    const std::string kind = force.kind == ForceKind::kChirp ? "chirp" : "pulse";
    if (!check.given(path + ".off")) {
      check.fail(path, "kind \"" + kind + "\" needs `off`, the time at which it is over");
    } else if (force.off == force.on) {
      check.fail(path + ".off",
                 "must be after `on` = " + number_text(force.on) + " s: a " + kind + " takes time");
    }
  }
}

}  // namespace

std::vector<Table> load_tables() {
  std::vector<Table> all{drive(), force(), base_table()};
  for (Table& table : magnetic_tables()) all.push_back(std::move(table));
  return all;
}

void check_loads(const Checker& check) {
  if (check.scene.drive) check_drive(check, *check.scene.drive);
  check_forces(check);
  check_base(check);
  check_magnetic_bearings(check);
}

}  // namespace rotorub::scene
