// [drive], [[force]] and [magnetic_bearing] ([base]: base_table.cc): rows, and what single keys
// cannot show.

#include "native_model/scene/checker.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/shaft_bearing.h"
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
          "`control` does; its excitation is a [[force]] at the same station. Or several of them, "
          "each [[magnetic_bearing]] with its own [magnetic_bearing.control].",
          "none",
          [](Scene& scene) -> void* { return &scene.magnetic_bearings.emplace_back(); },
          {key<&MagneticBearing::negative_stiffness>("negative_stiffness", kStiffness, ">= 0",
                                                     kRequired, "its size"),
           key<&MagneticBearing::shape>("shape", kPure, "", "all 1",
                                        "value of each bending mode at the station")
               .in(Form::kModal),
           key<&MagneticBearing::station>("station", kLength, ">= 0", kRequired, "along the shaft")
               .or_called("z")
               .in(Form::kGeometry),
           key<&MagneticBearing::sensor_shape>("sensor_shape", kPure, "", "`shape`",
                                               "the same where `control` sees the deflection")
               .in(Form::kModal),
           key<&MagneticBearing::sensor_station>("sensor_station", kLength, ">= 0", "`station`",
                                                 "where `control` sees the deflection")
               .in(Form::kGeometry)}};
}

Table bearing_control() {
  return {
      "magnetic_bearing.control",
      "The bearing's own feedback, on each of x and y by the deflection r at its sensor: the "
      "current i = -(`proportional` r + `integral` times the integral of r + `derivative` r'), "
      "within the limit, and its force `force_per_current` i (A magnetic bearing that holds the "
      "rotor). Needs [magnetic_bearing].",
      "the bearing holds nothing",
      [](Scene& scene) -> void* {
        if (scene.magnetic_bearings.empty()) scene.magnetic_bearings.emplace_back();
        return &scene.magnetic_bearings.back().control.emplace();
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

// N/m, of its own linear law.
double spring_of(const MagneticBearing& bearing) {
  if (!bearing.control) return -bearing.negative_stiffness;
  return bearing.control->force_per_current * bearing.control->proportional -
         bearing.negative_stiffness;
}

// The other supports leave the shaft no rigid motion in this plane: they hold it at two stations.
bool held_without(const Scene& scene, const MagneticBearing& magnetic, int plane) {
  std::vector<double> stations;
  for (const ShaftBearing& bearing : scene.rotor.geometry->bearings) {
    if (stiffness_at(bearing, scene.rotor.speed)[plane] > 0.0) stations.push_back(bearing.z);
  }
  for (const MagneticBearing& other : scene.magnetic_bearings) {
    if (&other != &magnetic && spring_of(other) > 0.0) stations.push_back(other.station);
  }
  return std::any_of(stations.begin(), stations.end(),
                     [&](double z) { return z != stations.front(); });
}

bool touches(const MagneticBearing& bearing, std::size_t mode) {
  return bearing.shape.empty() || (mode < bearing.shape.size() && bearing.shape[mode] != 0.0);
}

// What nothing but this magnetic bearing holds; empty: nothing.
std::string held_by_magnets(const Scene& scene, const MagneticBearing& magnetic) {
  const char* planes[] = {"x", "y"};
  if (scene.rotor.geometry) {
    for (int plane : {0, 1}) {
      if (held_without(scene, magnetic, plane)) continue;
      return std::string("the shaft against rigid motion in plane ") + planes[plane];
    }
  }
  if (!scene.rotor.modal) return {};
  const RotorModal& modal = *scene.rotor.modal;
  for (std::size_t k = 0; k < modal.stiffness.size(); ++k) {
    const bool free_y = k < modal.stiffness_y.size() && modal.stiffness_y[k] == 0.0;
    if (!touches(magnetic, k) || !(modal.stiffness[k] == 0.0 || free_y)) continue;
    if (std::any_of(scene.magnetic_bearings.begin(), scene.magnetic_bearings.end(),
                    [&](const MagneticBearing& other) {
                      return &other != &magnetic && touches(other, k) && spring_of(other) > 0.0;
                    }))
      continue;
    return "mode " + std::to_string(k + 1) + ", whose stiffness is 0, in plane " +
           planes[modal.stiffness[k] == 0.0 ? 0 : 1];
  }
  return {};
}

// What it alone holds it must hold.
void check_magnetic_bearing(const Checker& check, const MagneticBearing& magnetic,
                            const std::string& path) {
  check.station(path + ".station", magnetic.station);
  check.station(path + ".sensor_station", magnetic.sensor_station.value_or(0.0));
  if (const auto modes = check.bending_modes()) {
    check.list_length(path + ".shape", magnetic.shape, *modes, "bending mode");
    check.list_length(path + ".sensor_shape", magnetic.sensor_shape, *modes, "bending mode");
  }
  const std::string control_path = path + ".control";
  if (!magnetic.control) {
    for (const char* key : {".sensor_station", ".sensor_shape"}) {
      if (check.given(path + key)) {
        check.fail(path + key, "is where " + control_path +
                                   " sees the deflection, and there is "
                                   "none; accepted: one beside it");
      }
    }
    return;
  }
  if (!check.sound({path + ".negative_stiffness", control_path + ".force_per_current",
                    control_path + ".proportional"})) {
    return;
  }
  const BearingControl& control = *magnetic.control;
  if (control.integral > 0.0 && control.proportional == 0.0) {
    check.fail(control_path + ".integral",
               "needs " + control_path +
                   ".proportional, whose force the integrator replaces within P / I");
  }
  const double magnets = control.force_per_current * control.proportional;
  const double against = magnetic.negative_stiffness;
  if (magnets > against) return;
  const std::string held = held_by_magnets(check.scene, magnetic);
  if (held.empty()) return;
  check.fail(control_path + ".proportional",
             "times force_per_current is " + number_text(magnets) +
                 " N/m, and negative_stiffness takes " + number_text(against) +
                 " N/m of it: " + number_text(against - magnets) + " N/m too little to hold " +
                 held + ", which nothing else holds; accepted: more than " +
                 number_text(against / control.force_per_current) + " A/m");
}

}  // namespace

std::vector<Table> load_tables() {
  Table magnets = magnetic_bearing();
  magnets.or_list = true;
  return {drive(), force(), base_table(), std::move(magnets), bearing_control()};
}

void check_loads(const Checker& check) {
  if (check.scene.drive) check_drive(check, *check.scene.drive);
  check_forces(check);
  check_base(check);
  for (std::size_t k = 0; k < check.scene.magnetic_bearings.size(); ++k) {
    check_magnetic_bearing(check, check.scene.magnetic_bearings[k],
                           magnetic_bearing_path(&check.record, k));
  }
}

}  // namespace rotorub::scene
