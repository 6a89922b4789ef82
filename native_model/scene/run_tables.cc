// [run], [gravity], [initial] and [mujoco]: rows and cross-checks.

#include "native_model/scene/reading.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

// Rows of a series. The engines also check its columns (model/model_checks.h).
constexpr double kMostRows = 1e7;

Table gravity() {
  return {"gravity",
          "A constant acceleration in the x-y plane.",
          "none",
          [](Scene& scene) -> void* { return &scene.gravity.emplace(); },
          {key<&Gravity::acceleration>("acceleration", kAcceleration, "", kRequired,
                                       "for example [0, -9.81]"),
           key<&Gravity::participation>("participation", kMass, "", "the modal mass",
                                        "modal load per unit acceleration")
               .in(Form::kModal)}};
}

// A key of [initial] that is stored in the first ring, if the scene has one.
template <auto Member>
Key start_of_ring(std::string_view name, const Quantity& quantity, std::string_view meaning) {
  Key result = key<Member>(name, quantity, "", kStandard, meaning);
  result.store = [](void* object, const Value& value) {
    if (auto& ring = static_cast<Scene*>(object)->first().stator) (*ring).*Member = value.pair;
  };
  return result;
}

Table initial() {
  return {
      "initial",
      "State at t = 0; lists have one value per mode.",
      "all 0",
      [](Scene& scene) -> void* { return &scene; },
      {key<&Scene::initial, &Initial::steady>(
           "steady", kPure, "", kStandard,
           "start on the steady free orbit; not beside `x` to `vy`, `stator`, `stator_velocity`"),
       word<&Scene::initial, &Initial::rub>(
           "rub", {"none", "synchronous", "whip", "rolling"}, kStandard,
           "start on this lasting rub (`rotorub modes`); not beside `steady` or another start"),
       key<&Scene::initial, &Initial::x>("x", kLength, "", "0", "modal displacements"),
       key<&Scene::initial, &Initial::y>("y", kLength, "", "0", "modal displacements"),
       key<&Scene::initial, &Initial::vx>("vx", kVelocity, "", "0", "modal velocities"),
       key<&Scene::initial, &Initial::vy>("vy", kVelocity, "", "0", "modal velocities"),
       key<&Scene::initial, &Initial::spin_angle>("spin_angle", kAngle, "", kStandard,
                                                  "angle of the rotor's x axis"),
       key<&Scene::initial, &Initial::torsion>("torsion", kAngle, "", "0", "torsion mode angles"),
       key<&Scene::initial, &Initial::torsion_speed>("torsion_speed", kSpin, "", "0",
                                                     "torsion mode speeds"),
       start_of_ring<&Stator::position>("stator", kLength, "ring position; needs [stator]"),
       start_of_ring<&Stator::velocity>("stator_velocity", kVelocity,
                                        "ring velocity; needs [stator]")}};
}

Table mujoco() {
  return {
      "mujoco",
      "MuJoCo's model and settings.",
      "the defaults",
      [](Scene& scene) -> void* { return &scene.mujoco; },
      {word<&Mujoco::rotor>("rotor", {"modal", "segments"}, kStandard,
                            "native coordinates, or rigid segments (geometry form)"),
       key<&Mujoco::segments>("segments", kPure, "in [2, 200]", kStandard,
                              "pieces of the segment rotor"),
       word<&Mujoco::contact>("contact", contact_words<std::vector<std::string_view>>(), kStandard,
                              "`rigid`: the plugin's impulses; `coulomb`: soft normal contact with "
                              "Coulomb friction; `cone`: MuJoCo's friction cone; "
                              "`cone-coulomb`: the cone, corrected for sliding"),
       word<&Mujoco::integrator>("integrator", {"euler", "implicit", "rk4"}, kStandard,
                                 "MuJoCo's integrator"),
       word<&Mujoco::solver>("solver", {"newton", "cg", "pgs"}, kStandard,
                             "MuJoCo's constraint solver"),
       key<&Mujoco::solref_stiffness>("solref_stiffness", kRateSquared, "> 0",
                                      "by the step; for the cones also by the scene's speeds",
                                      "K of the soft contact (direct solref)"),
       key<&Mujoco::solref_damping>("solref_damping", kRate, "> 0", "by contact.restitution",
                                    "B of the soft contact (direct solref)"),
       key<&Mujoco::friction_reference>(
           "friction_reference", kRate, "> 0", "as for the normal row",
           "B_t of the friction rows of `cone` (solreffriction of MuJoCo 2.3.6)"),
       key<&Mujoco::shadow>("shadow", kPure, "", kStandard, "run the native model alongside"),
       key<&Mujoco::bearing_currents>("bearing_currents", kPure, "", kStandard,
                                      "two actuators per magnetic bearing with amplifier")}};
}

void check_initial_lists(const Reading& check) {
  for (const char* key :
       {"initial.x", "initial.y", "initial.vx", "initial.vy", "gravity.participation"}) {
    check.list_length(key, check.bending_modes(), "bending mode");
  }
  for (const char* key : {"initial.torsion", "initial.torsion_speed"}) {
    if (check.given("rotor"))
      check.needs(key, "[rotor.torsion]", ": the rotor has no torsion modes");
    check.list_length(key, check.torsion_modes(), "torsion mode");
  }
}

// With `steady` or `rub`, no other key may give a bending of the rotor or a motion of the ring.
void check_given_start(const Reading& check) {
  const Initial& initial = check.scene.initial;
  const bool rubs = initial.rub != StartingRub::kNone;
  if (!initial.steady && !rubs) return;
  const std::string by = rubs ? "initial.rub" : "initial.steady";
  for (const char* key : {"initial.x", "initial.y", "initial.vx", "initial.vy", "initial.stator",
                          "initial.stator_velocity"}) {
    check.excludes(key, by, ", which sets it");
  }
  for (const char* key : {"stator.position", "stator.velocity"}) {
    if (rubs) check.excludes(key, by, ", which sets it");
  }
  if (initial.steady && rubs) {
    check.fail(
        "initial.steady",
        "cannot be true together with initial.rub, because the free orbit is not a rub; remove one "
        "of them");
  }
}

void check_mujoco(const Reading& check) {
  const Scene& scene = check.scene;
  if (scene.mujoco.bearing_currents && scene.mujoco.shadow) {
    check.fail("mujoco.bearing_currents",
               "cannot be true together with mujoco.shadow, which does not see the added currents; "
               "set one "
               "of them to false");
  }
  const auto amplifies = [](const MagneticBearing& b) { return b.amplifier.has_value(); };
  if (scene.mujoco.bearing_currents && std::ranges::none_of(scene.magnetic_bearings, amplifies)) {
    check.fail("mujoco.bearing_currents",
               "needs a magnetic bearing with an amplifier; add [magnetic_bearing.amplifier], or "
               "set false");
  }
  if (scene.mujoco.rotor != MujocoRotor::kSegments) return;
  for (std::size_t i = 0; scene.drive && i < scene.forces.size(); ++i) {
    if (scene.forces[i].kind != ForceKind::kUnbalance) continue;
    check.fail(list_element("force", i) + ".kind",
               "with a [drive], \"unbalance\" changes how spin and bending are coupled, but "
               "MuJoCo's rigid "
               "segments keep their masses; set mujoco.rotor = \"modal\", or remove [drive]");
  }
  for (std::size_t i = 0; scene.rotor.geometry && i < scene.rotor.geometry->bearings.size(); ++i) {
    const ShaftBearing& bearing = scene.rotor.geometry->bearings[i];
    const char* key = bearing.pedestal                       ? ".pedestal"
                      : bearing.journal                      ? ".journal"
                      : bearing.follows_speed()              ? ".table_speed"
                      : !bearing.cross_stiffness.isZero(0.0) ? ".cross_stiffness"
                      : !bearing.cross_damping.isZero(0.0)   ? ".cross_damping"
                      : !bearing.offset.isZero(0.0)          ? ".offset"
                                                             : nullptr;
    if (key == nullptr) continue;
    check.fail(list_element("rotor.bearing", i) + key,
               "MuJoCo's rigid segments support only uncoupled springs and dampers; set "
               "mujoco.rotor = \"modal\"");
  }
  if (scene.rotor.modal) {
    check.fail(
        "mujoco.rotor",
        "\"segments\" needs the rotor's geometry, but this scene gives its modes; set \"modal\"");
  }
}

}  // namespace

Table run_table() {
  return {"run",
          "Duration, steps and output.",
          "the defaults",
          [](Scene& scene) -> void* { return &scene.run; },
          {key<&Run::end>("end", kTime, "> 0", kStandard, "end of the run"),
           key<&Run::step>("step", kTime, "> 0", kStandard,
                           "time step of MuJoCo, `verlet` and `euler`"),
           word<&Run::integrator>("integrator", {"event", "verlet", "euler"}, kStandard,
                                  "native integrator"),
           key<&Run::output_step>("output_step", kTime, "> 0", "`end` / 1000",
                                  "time between rows of the series"),
           key<&Run::output_times>("output_times", kTime, ">= 0", "none",
                                   "further row times up to `end`")}};
}

std::vector<Table> start_tables() { return {gravity(), initial(), mujoco()}; }

void check_run(const Reading& check) {
  const Run& run = check.scene.run;
  if (!check.sound({"run.end"})) return;
  const std::string end = "run.end = " + number_text(run.end) + " s";
  // `event` uses adaptive steps.
  if (check.sound({"run.step"}) && run.integrator != Integrator::kEvent && run.step > run.end) {
    check.fail("run.step", "must be at most " + end);
  }
  if (check.sound({"run.output_step"}) && run.end / run.series_step() > kMostRows) {
    check.fail("run.output_step", "makes " + number_text(run.end / run.series_step()) +
                                      " rows, but at most 1e7 rows are accepted; set " +
                                      number_text(run.end / kMostRows) + " s or more");
  }
  if (!check.sound({"run.output_times"})) return;
  for (std::size_t i = 0; i < run.output_times.size(); ++i) {
    if (run.output_times[i] > run.end) {
      check.fail(list_element("run.output_times", i), "must be in [0, " + end + "]");
    }
  }
}

void check_start(const Reading& check) {
  check_initial_lists(check);
  check_given_start(check);
  check_mujoco(check);
}

}  // namespace rotorub::scene
