// [drive] and [[force]]: rows and cross-checks. ([base] is in base_table.cc, magnetic bearings are
// in magnetic_tables.cc.)

#include "native_model/scene/reading.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

Table drive() {
  return {
      "drive",
      "The motor's torque T on the spin.",
      "the spin speed is held at `rotor.speed`",
      [](Scene& scene) -> void* { return &scene.drive.emplace(); },
      {word<&Drive::kind>("kind", {"free", "linear", "kloss", "table", "speed_controlled"},
                          kRequired,
                          "`free`: T = 0; `linear`: T = `gain` (`speed` - Omega); `kloss` "
                          "(asynchronous): T = 2 T_b s s_b/(s^2 + s_b^2), s = 1 - "
                          "Omega/`synchronous_speed`; `table`: T(Omega); `speed_controlled`: PI"),
       key<&Drive::gain>("gain", kAngularDamping, ">= 0", kRequired, "torque per speed difference",
                         {"linear", "speed_controlled"}),
       key<&Drive::speed>("speed", kSpin, "", kRequired, "set speed",
                          {"linear", "speed_controlled"}),
       key<&Drive::integral_gain>("integral_gain", kAngularStiffness, ">= 0", kStandard,
                                  "torque per integrated speed difference", {"speed_controlled"}),
       key<&Drive::torque_limit>("torque_limit", kTorque, "> 0", "none", "largest torque",
                                 {"speed_controlled"}),
       key<&Drive::acceleration>("acceleration", kAngularAcceleration, "> 0", "`speed` at once",
                                 "of the ramp from `rotor.speed`", {"speed_controlled"}),
       key<&Drive::breakdown_torque>("breakdown_torque", kTorque, "> 0", kRequired,
                                     "T_b, largest torque", {"kloss"}),
       key<&Drive::breakdown_slip>("breakdown_slip", kPure, "> 0", kRequired, "s_b, slip at T_b",
                                   {"kloss"}),
       key<&Drive::synchronous_speed>("synchronous_speed", kSpin, "> 0", kRequired,
                                      "speed at which T = 0", {"kloss"}),
       key<&Drive::table_speed>("table_speed", kSpin, "", kRequired,
                                "ascending speeds, two or more", {"table"}),
       key<&Drive::table_torque>("table_torque", kTorque, "", kRequired,
                                 "T there, interpolated as in [[rotor.bearing]]", {"table"}),
       key<&Drive::station>("station", kLength, ">= 0", kStandard, "axial position of the motor")
           .or_called("z")
           .in(Form::kGeometry),
       key<&Drive::inertia>("inertia", kInertia, ">= 0", kStandard, "inertia of the motor's rotor")
           .in(Form::kGeometry)}};
}

Table force() {
  return Table{
      "force",
      "Forces on the rotor, for `on` <= t < `off`.",
      "none",
      [](Scene& scene) -> void* { return &scene.forces.emplace_back(); },
      {word<&Force::kind>("kind",
                          {"rotating", "constant", "synchronous", "chirp", "pulse", "unbalance"},
                          kRequired,
                          "`synchronous`: turns with the spin, without torque on it; `chirp`: from "
                          "`frequency` at `on` to `frequency_end` at `off`, linearly; `pulse`: a "
                          "half-sine; `unbalance`: a blade lost at `on`"),
       key<&Force::amplitude>("amplitude", kForce, "", kRequired, "size; negative: opposite",
                              {"rotating", "synchronous", "chirp"}),
       key<&Force::frequency>("frequency", kSpin, "", kRequired,
                              "turning speed; negative: backward", {"rotating", "chirp"}),
       key<&Force::frequency_end>("frequency_end", kSpin, "", kRequired, "frequency at `off`",
                                  {"chirp"}),
       key<&Force::static_moment>("static_moment", kStaticMoment, ">= 0", kRequired,
                                  "mass times eccentricity", {"unbalance"}),
       key<&Force::phase>("phase", kAngle, "", kStandard,
                          "angle from the x axis at t = 0 (`chirp`: at `on`), or from the rotor's "
                          "x axis (`synchronous`, `unbalance`)",
                          {"rotating", "synchronous", "chirp", "unbalance"}),
       key<&Force::vector>("vector", kForce, "", kRequired, "force, or peak of the pulse",
                           {"constant", "pulse"}),
       key<&Force::on>("on", kTime, "", kStandard, "start"),
       key<&Force::off>("off", kTime, "", "never", "end; required for `chirp` and `pulse`",
                        {"rotating", "constant", "synchronous", "chirp", "pulse"}),
       key<&Force::ramp>("ramp", kTime, ">= 0", kStandard, "linear rise time after `on`",
                         {"rotating", "constant", "synchronous", "chirp"}),
       key<&Force::shape>("shape", kPure, "", "all 1", "mode values at the station")
           .in(Form::kModal),
       key<&Force::station>("station", kLength, ">= 0", kRequired, "axial position")
           .or_called("z")
           .in(Form::kGeometry)}}
      .as_list();
}

void check_drive(const Reading& check, const Drive& drive) {
  check.station("drive.station", drive.station);
  if (drive.kind != DriveKind::kTable || !check.given("drive.table_speed") ||
      !check.sound({"drive.table_speed"})) {
    return;
  }
  const std::vector<double>& speed = drive.table_speed;
  check.abscissae("drive.table_speed", speed, "two speeds");
  check.list_length("drive.table_torque", speed.size(), "speed of drive.table_speed");
}

void check_forces(Reading& check) {
  for (std::size_t i = 0; i < check.scene.forces.size(); ++i) {
    check.at = list_element("force", i);
    const Force& force = check.scene.forces[i];
    check.station(".station", force.station);
    check.list_length(".shape", check.bending_modes(), "bending mode");
    if (!check.sound({".on", ".off"})) continue;
    const std::string on = "`on` = " + number_text(force.on) + " s";
    if (force.off < force.on) check.fail(".off", "must not be before " + on);
    const bool passes = force.kind == ForceKind::kChirp || force.kind == ForceKind::kPulse;
    if (!passes || !check.sound({".kind"})) continue;
    const std::string kind = force.kind == ForceKind::kChirp ? "chirp" : "pulse";
    if (!check.given(".off")) {
      check.fail(check.at, "kind \"" + kind + "\" needs `off`, the time at which it ends");
    } else if (force.off == force.on) {
      check.fail(".off", "must be after " + on + ": a " + kind + " takes time");
    }
  }
}

}  // namespace

std::vector<Table> load_tables() {
  std::vector<Table> all{drive(), force(), base_table()};
  for (Table& table : magnetic_tables()) all.push_back(std::move(table));
  return all;
}

void check_loads(Reading& check) {
  if (check.scene.drive) check_drive(check, *check.scene.drive);
  check_forces(check);
  check_base(check);
  check_magnetic_bearings(check);
}

}  // namespace rotorub::scene
