// Cross-checks of everything around the rotor.

#include <algorithm>

#include "native_model/scene/checker.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

constexpr double kMostRows =
    1e7;  // of a series; the engines know its columns too (system/run_size.h)
constexpr double kGapTolerance =
    1e-9;  // of the clearance: a rotor that starts on the ring is meant to

void check_run(const Checker& check) {
  const Run& run = check.scene.run;
  if (!check.record.sound({"run.end"})) return;
  const std::string end = "run.end = " + number_text(run.end) + " s";
  if (check.record.sound({"run.step"}) && run.step > run.end) {
    check.fail("run.step", "must be at most " + end);
  }
  if (check.record.sound({"run.output_step"}) && run.end / run.series_step() > kMostRows) {
    check.fail("run.output_step", "gives " + number_text(run.end / run.series_step()) +
                                      " rows; expected at most 1e7 rows, one in " +
                                      number_text(run.end / kMostRows) + " s");
  }
  if (!check.record.sound({"run.output_times"})) return;
  for (std::size_t i = 0; i < run.output_times.size(); ++i) {
    if (run.output_times[i] > run.end) {
      check.fail(list_element("run.output_times", i), "must be in [0, " + end + "]");
    }
  }
}

void check_drive(const Checker& check, const Drive& drive) {
  check.station("drive.station", drive.station);
  if (drive.kind != DriveKind::kTable || !check.record.given("drive.table_speed") ||
      !check.record.sound({"drive.table_speed"})) {
    return;
  }
  const std::vector<double>& speed = drive.table_speed;
  if (speed.size() < 2) check.fail("drive.table_speed", "expected two speeds or more");
  if (std::adjacent_find(speed.begin(), speed.end(), std::greater_equal<>()) != speed.end()) {
    check.fail("drive.table_speed", "must be strictly ascending");
  }
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
    if (check.record.sound({path + ".on", path + ".off"}) && force.off < force.on) {
      check.fail(path + ".off", "must not be before `on` = " + number_text(force.on) + " s");
    }
    const bool passes = force.kind == ForceKind::kChirp || force.kind == ForceKind::kPulse;
    if (!passes || !check.record.sound({path + ".kind", path + ".on", path + ".off"})) continue;
    const std::string kind = force.kind == ForceKind::kChirp ? "chirp" : "pulse";
    if (!check.record.given(path + ".off")) {
      check.fail(path, "kind \"" + kind + "\" needs `off`, the time at which it is over");
    } else if (force.off == force.on) {
      check.fail(path + ".off", "must be after `on` = " + number_text(force.on) + " s: a " + kind +
                                    " takes time");
    }
  }
}

void check_ring(const Checker& check) {
  const Scene& scene = check.scene;
  const bool has_ring = check.record.given("stator");
  if (scene.contact) check.station("contact.station", scene.contact->station);
  if (scene.actuator && !has_ring) {
    check.fail("actuator", "needs [stator]: the ring is fixed, and there is nothing to move");
  }
  if (scene.stator && scene.stator->spin && !check.record.given("contact")) {
    check.fail("stator.spin", "needs [contact]: nothing else turns the ring");
  }
  for (const char* key : {"initial.stator", "initial.stator_velocity"}) {
    if (check.record.given(key) && !has_ring) {
      check.fail(key, "needs [stator]: the ring is fixed and stays at [0, 0]");
    }
  }
}

void check_force_table(const Checker& check, const Actuator& actuator) {
  constexpr std::size_t kLeast = 4;  // of a cubic
  const std::vector<double>&position = actuator.table_position, &current = actuator.table_current;
  bool sound = true;
  const auto refuse = [&](const char* key, const std::string& reason) {
    check.fail(key, reason);
    sound = false;
  };
  for (const auto& [key, list] : {std::pair("actuator.table_position", &position),
                                  std::pair("actuator.table_current", &current)}) {
    if (!check.record.given(key) || !check.record.sound({key})) {
      sound = false;
    } else if (list->size() < kLeast) {
      refuse(key, "expected four values or more");
    } else if (std::adjacent_find(list->begin(), list->end(), std::greater_equal<>()) !=
               list->end()) {
      refuse(key, "must be strictly ascending");
    }
  }
  if (sound && !(current.front() < 0.0 && current.back() > 0.0)) {
    refuse("actuator.table_current", "must reach from below 0 to above 0");
  }
  if (!sound || !check.record.given("actuator.table_force") ||
      !check.record.sound({"actuator.table_force"})) {
    return;
  }
  const std::vector<double>& force = actuator.table_force;
  if (force.size() != position.size() * current.size()) {
    return check.fail("actuator.table_force",
                      "expected " + std::to_string(position.size() * current.size()) +
                          " values, for each position one for each current, got " +
                          std::to_string(force.size()));
  }
  const double most = std::min(-current.front(), current.back());
  if (check.record.sound({"actuator.current_limit"}) && actuator.current_limit > most) {
    check.fail("actuator.current_limit", "must be within the table, at most " + number_text(most) + " A");
  }
}

void check_actuator(const Checker& check, const Actuator& actuator) {
  if (actuator.kind == ActuatorKind::kIdeal) return;
  if (actuator.kind == ActuatorKind::kTable) check_force_table(check, actuator);
  if (actuator.kind == ActuatorKind::kElectromagnet &&
      check.record.sound({"actuator.bias_current", "actuator.current_limit"}) &&
      actuator.current_limit > actuator.bias_current) {
    check.fail("actuator.current_limit",
               "must be at most actuator.bias_current = " + number_text(actuator.bias_current) +
                   " A: beyond it a magnet's current would turn round");
  }
  for (const char* key : {"actuator.current_rate_limit", "actuator.voltage_limit"}) {
    if (check.record.given(key) && actuator.coil_lag == 0.0 && check.record.sound({"actuator.coil_lag"})) {
      check.fail(key, "needs actuator.coil_lag: without it the current follows at once");
    }
  }
  const bool limited = check.record.given("actuator.voltage_limit");
  if (limited && !check.record.given("actuator.inductance")) {
    check.fail("actuator.voltage_limit", "needs actuator.inductance: inductance di/dt = u - resistance i");
  }
  for (const char* key : {"actuator.inductance", "actuator.resistance"}) {
    if (!limited && check.record.given(key)) {
      check.fail(key, "needs actuator.voltage_limit: a voltage without limit gives every current");
    }
  }
}

void check_initial_lists(const Checker& check) {
  const Initial& initial = check.scene.initial;
  if (const auto modes = check.bending_modes()) {
    check.list_length("initial.x", initial.x, *modes, "bending mode");
    check.list_length("initial.y", initial.y, *modes, "bending mode");
    check.list_length("initial.vx", initial.vx, *modes, "bending mode");
    check.list_length("initial.vy", initial.vy, *modes, "bending mode");
    if (check.scene.gravity) {
      check.list_length("gravity.participation", check.scene.gravity->participation, *modes,
                        "bending mode");
    }
  }
  const auto torsion_list = [&](const char* path, const std::vector<double>& list) {
    if (check.record.given(path) && check.record.given("rotor") &&
        !check.record.given("rotor.torsion")) {
      check.fail(path, "needs [rotor.torsion]: the rotor has no torsion modes");
    } else if (const auto modes = check.torsion_modes()) {
      check.list_length(path, list, *modes, "torsion mode");
    }
  };
  torsion_list("initial.torsion", initial.torsion);
  torsion_list("initial.torsion_speed", initial.torsion_speed);
}

// Modal form: the contact point is the plain sum of the modes. (In the geometry form a mode with a
// node at the contact is scaled otherwise; that is known only once the modes are.)
void check_initial_gap(const Checker& check) {
  const Scene& scene = check.scene;
  if (!scene.rotor.modal || !scene.contact ||
      !check.record.sound({"contact.clearance", "initial.x", "initial.y", "initial.stator"})) {
    return;
  }
  Eigen::Vector2d offset = -scene.initial.stator;
  for (double x : scene.initial.x) offset.x() += x;
  for (double y : scene.initial.y) offset.y() += y;
  const double clearance = scene.contact->clearance;
  if (offset.norm() > clearance * (1.0 + kGapTolerance)) {
    const char* key = check.record.given("initial.x")   ? "initial.x"
                      : check.record.given("initial.y") ? "initial.y"
                                                        : "initial.stator";
    check.fail(key, "the rotor starts outside the ring, " + number_text(offset.norm()) +
                        " m from its centre; expected at most contact.clearance = " +
                        number_text(clearance) + " m");
  }
}

// All of the start that bends or moves the ring is given by `steady`.
void check_steady(const Checker& check) {
  if (!check.scene.initial.steady) return;
  for (const char* key : {"initial.x", "initial.y", "initial.vx", "initial.vy", "initial.stator",
                          "initial.stator_velocity"}) {
    if (!check.record.given(key)) continue;
    check.fail(key, "not beside initial.steady, which gives it; accepted: one of the two");
  }
}

void check_mujoco(const Checker& check) {
  const Scene& scene = check.scene;
  for (std::size_t i = 0; i < scene.forces.size(); ++i) {
    if (scene.forces[i].kind != ForceKind::kUnbalance || !scene.drive ||
        scene.mujoco.rotor != MujocoRotor::kSegments) {
      continue;
    }
    check.fail(list_element("force", i) + ".kind",
               "with a [drive] \"unbalance\" changes how spin and bending are coupled, and MuJoCo's "
               "rigid segments keep their masses; accepted: mujoco.rotor = \"modal\", or no [drive]");
  }
  for (std::size_t i = 0; scene.rotor.geometry && i < scene.rotor.geometry->bearings.size(); ++i) {
    const ShaftBearing& bearing = scene.rotor.geometry->bearings[i];
    if (scene.mujoco.rotor != MujocoRotor::kSegments) break;
    const char* key = bearing.follows_speed()                     ? ".table_speed"
                      : !bearing.cross_stiffness.isZero(0.0)      ? ".cross_stiffness"
                      : !bearing.cross_damping.isZero(0.0)        ? ".cross_damping"
                      : !bearing.offset.isZero(0.0)               ? ".offset"
                                                                  : nullptr;
    if (key == nullptr) continue;
    check.fail(list_element("rotor.bearing", i) + key,
               "MuJoCo's rigid segments stand on springs and dashpots alone; accepted: mujoco.rotor = \"modal\"");
  }
  if (scene.mujoco.rotor == MujocoRotor::kSegments && scene.rotor.modal) {
    check.fail("mujoco.rotor",
               "\"segments\" needs the rotor's geometry, and the scene gives its modes; accepted: "
               "\"modal\"");
  }
}

}  // namespace

void check_parts(const Checker& check) {
  check_run(check);
  if (check.scene.drive) check_drive(check, *check.scene.drive);
  check_forces(check);
  check_magnetic_bearing(check);
  check_ring(check);
  if (check.scene.actuator) check_actuator(check, *check.scene.actuator);
  check_initial_lists(check);
  check_initial_gap(check);
  check_steady(check);
  check_mujoco(check);
}

}  // namespace rotorub::scene
