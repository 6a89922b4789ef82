// Cross-checks of everything around the rotor.

#include <algorithm>

#include "native_model/scene/checker.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

constexpr double kMostRows =
    1e7;  // of a series; the engines know its columns too (system/model_checks.h)
constexpr double kGapTolerance =
    1e-9;  // of the clearance: a rotor that starts on the ring is meant to

void check_run(const Checker& check) {
  const Run& run = check.scene.run;
  if (!check.sound({"run.end"})) return;
  const std::string end = "run.end = " + number_text(run.end) + " s";
  if (check.sound({"run.step"}) && run.step > run.end) {
    check.fail("run.step", "must be at most " + end);
  }
  if (check.sound({"run.output_step"}) && run.end / run.series_step() > kMostRows) {
    check.fail("run.output_step", "gives " + number_text(run.end / run.series_step()) +
                                      " rows; expected at most 1e7 rows, one in " +
                                      number_text(run.end / kMostRows) + " s");
  }
  if (!check.sound({"run.output_times"})) return;
  for (std::size_t i = 0; i < run.output_times.size(); ++i) {
    if (run.output_times[i] > run.end) {
      check.fail(list_element("run.output_times", i), "must be in [0, " + end + "]");
    }
  }
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

void check_ring(const Checker& check) {
  const AuxiliaryBearing& bearing = check.bearing();
  const bool has_ring = check.given("stator");
  if (bearing.contact) check.station("contact.station", bearing.contact->station);
  if (bearing.actuator && !has_ring) {
    check.fail("actuator", "needs [stator]: the ring is fixed, and there is nothing to move");
  }
  if (bearing.stator && bearing.stator->spin && !check.given("contact")) {
    check.fail("stator.spin", "needs [contact]: nothing else turns the ring");
  }
  for (const char* key : {"initial.stator", "initial.stator_velocity"}) {
    if (!check.given(key) || check.index > 0) continue;
    if (check.given("contact[0]")) {
      check.fail(key,
                 "is not known beside [[contact]]; accepted: position and velocity in each "
                 "[contact.stator]");
    } else if (!has_ring) {
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
    if (!check.given(key) || !check.sound({key})) {
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
  if (!sound || !check.given("actuator.table_force") || !check.sound({"actuator.table_force"})) {
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
  if (check.sound({"actuator.current_limit"}) && actuator.current_limit > most) {
    check.fail("actuator.current_limit",
               "must be within the table, at most " + number_text(most) + " A");
  }
}

void check_actuator(const Checker& check, const Actuator& actuator) {
  if (actuator.kind == ActuatorKind::kIdeal) return;
  if (actuator.kind == ActuatorKind::kTable) check_force_table(check, actuator);
  if (actuator.kind == ActuatorKind::kElectromagnet &&
      check.sound({"actuator.bias_current", "actuator.current_limit"}) &&
      actuator.current_limit > actuator.bias_current) {
    check.fail("actuator.current_limit",
               "must be at most actuator.bias_current = " + number_text(actuator.bias_current) +
                   " A: beyond it a magnet's current would turn round");
  }
  for (const char* key : {"actuator.current_rate_limit", "actuator.voltage_limit"}) {
    if (check.given(key) && actuator.coil_lag == 0.0 && check.sound({"actuator.coil_lag"})) {
      check.fail(key, "needs actuator.coil_lag: without it the current follows at once");
    }
  }
  const bool limited = check.given("actuator.voltage_limit");
  if (limited && !check.given("actuator.inductance")) {
    check.fail("actuator.voltage_limit",
               "needs actuator.inductance: inductance di/dt = u - resistance i");
  }
  for (const char* key : {"actuator.inductance", "actuator.resistance"}) {
    if (!limited && check.given(key)) {
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
    if (check.given(path) && check.given("rotor") && !check.given("rotor.torsion")) {
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
  const AuxiliaryBearing& bearing = check.bearing();
  if (!scene.rotor.modal || !bearing.contact ||
      !check.sound(
          {"contact.clearance", "contact.shape", "initial.x", "initial.y", "initial.stator"})) {
    return;
  }
  Eigen::Vector2d offset{0.0, 0.0};
  if (bearing.stator) offset -= bearing.stator->position;
  const std::vector<double>& shape = bearing.contact->shape;
  const auto add = [&shape](const std::vector<double>& modes, double& sum) {
    for (std::size_t i = 0; i < modes.size(); ++i)
      sum += (i < shape.size() ? shape[i] : 1.0) * modes[i];
  };
  add(scene.initial.x, offset.x());
  add(scene.initial.y, offset.y());
  const double clearance = bearing.contact->clearance;
  if (offset.norm() > clearance * (1.0 + kGapTolerance)) {
    const char* key = check.given("initial.x")   ? "initial.x"
                      : check.given("initial.y") ? "initial.y"
                                                 : "initial.stator";
    check.fail(key, "the rotor starts outside the ring, " + number_text(offset.norm()) +
                        " m from its centre; expected at most " + check.place("contact.clearance") +
                        " = " + number_text(clearance) + " m");
  }
}

// All of the start that bends or moves the ring is given by `steady`.
void check_steady(const Checker& check) {
  if (!check.scene.initial.steady) return;
  for (const char* key : {"initial.x", "initial.y", "initial.vx", "initial.vy", "initial.stator",
                          "initial.stator_velocity"}) {
    if (!check.given(key)) continue;
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
    check.fail(
        list_element("force", i) + ".kind",
        "with a [drive] \"unbalance\" changes how spin and bending are coupled, and MuJoCo's "
        "rigid segments keep their masses; accepted: mujoco.rotor = \"modal\", or no [drive]");
  }
  for (std::size_t i = 0; scene.rotor.geometry && i < scene.rotor.geometry->bearings.size(); ++i) {
    const ShaftBearing& bearing = scene.rotor.geometry->bearings[i];
    if (scene.mujoco.rotor != MujocoRotor::kSegments) break;
    const char* key = bearing.follows_speed()                ? ".table_speed"
                      : !bearing.cross_stiffness.isZero(0.0) ? ".cross_stiffness"
                      : !bearing.cross_damping.isZero(0.0)   ? ".cross_damping"
                      : !bearing.offset.isZero(0.0)          ? ".offset"
                                                             : nullptr;
    if (key == nullptr) continue;
    check.fail(list_element("rotor.bearing", i) + key,
               "MuJoCo's rigid segments stand on springs and dashpots alone; accepted: "
               "mujoco.rotor = \"modal\"");
  }
  if (scene.mujoco.rotor == MujocoRotor::kSegments && scene.rotor.modal) {
    check.fail("mujoco.rotor",
               "\"segments\" needs the rotor's geometry, and the scene gives its modes; accepted: "
               "\"modal\"");
  }
}

// Mode values at the station; the first contact is where the modes are scaled to 1.
void check_contact_shapes(const Checker& check) {
  if (!check.bearing().contact) return;
  const Contact& contact = *check.bearing().contact;
  const auto one = [&](const char* key, const std::vector<double>& shape,
                       std::optional<std::size_t> modes, const char* of) {
    if (modes) check.list_length(key, shape, *modes, of);
    if (check.index > 0 ||
        std::all_of(shape.begin(), shape.end(), [](double s) { return s == 1.0; }))
      return;
    check.fail(
        key,
        "must be 1 for each mode, as the modes are scaled to 1 at the first contact; accepted: "
        "modes scaled so, or another contact first");
  };
  one("contact.shape", contact.shape, check.bending_modes(), "bending mode");
  one("contact.torsion_shape", contact.torsion_shape, check.torsion_modes(), "torsion mode");
}

// Names are one of each; what stands once in a file stands for one bearing.
void check_list(const Checker& check) {
  for (std::size_t k = 0; k < check.index; ++k) {
    if (check.scene.name_of(k) != check.scene.name_of(check.index)) continue;
    check.fail("contact.name",
               "is the name of " + list_element("contact", k) + " too; accepted: one of its own");
  }
  if (check.scene.auxiliary.size() < 2 || !check.bearing().contact) return;
  for (const char* key : {"contact.compression_time", "contact.expansion_time"}) {
    const Contact& c = *check.bearing().contact;
    if ((key == std::string("contact.expansion_time") ? c.expansion_time : c.compression_time) ==
        0.0)
      continue;
    check.fail(
        key, "an impact that takes time is known of one contact alone; accepted beside others: 0");
  }
}

}  // namespace

void check_bearing(const Checker& check) {
  check_ring(check);
  if (check.bearing().actuator) check_actuator(check, *check.bearing().actuator);
  check_contact_shapes(check);
  check_initial_gap(check);
  check_list(check);
}

void check_parts(const Checker& check) {
  check_run(check);
  if (check.scene.drive) check_drive(check, *check.scene.drive);
  check_forces(check);
  check_magnetic_bearing(check);
  check_initial_lists(check);
  check_steady(check);
  check_mujoco(check);
}

}  // namespace rotorub::scene
