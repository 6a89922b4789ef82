#include "compare/engine/continued.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {
namespace {

// Last values of the columns name_1, name_2, ...
std::vector<double> last_of(const Trajectory& run, const std::string& name) {
  std::vector<double> all;
  for (std::size_t k = 1; run.has(name + "_" + std::to_string(k)); ++k)
    all.push_back(run.column(name + "_" + std::to_string(k)).back());
  return all;
}

bool remembers(const scene::AuxiliaryBearing& at) {
  return (at.controller && at.controller->kind != scene::ControllerKind::kPassive) ||
         (at.contact && (at.contact->compression_time > 0.0 || at.contact->expansion_time > 0.0));
}

}  // namespace

std::string not_continued(const scene::Scene& scene) {
  if (std::ranges::any_of(scene.auxiliary, remembers))
    return "the state of a controller, or of an impact of finite duration, cannot be given as a "
           "start";
  if (!scene.magnetic_bearings.empty())
    return "the state of magnetic bearings cannot be given as a start";
  for (const scene::AuxiliaryBearing& at : scene.auxiliary) {
    if (at.stator && (at.stator->spin || at.stator->mount || at.stator->dry_friction))
      return "the state of a turning ring, a housing or dry friction cannot be given as a start";
  }
  if (scene.drive && scene.drive->kind == scene::DriveKind::kSpeedControlled)
    return "the state of the drive's speed control cannot be given as a start";
  if (scene.base) return "the motion of the base depends on time";
  for (const scene::Force& f : scene.forces) {
    if (f.kind == scene::ForceKind::kChirp || f.kind == scene::ForceKind::kPulse)
      return "a [[force]] changes in time and does not repeat";
  }
  return {};
}

scene::Scene continued(const scene::Scene& next, const scene::Scene& before,
                       const Trajectory& run) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  scene::Scene scene = next;
  const auto last = [&](const std::string& name) { return run.column(name).back(); };
  const double spent = run.column("t").back();
  scene.initial.steady = false;
  scene.initial.rub = scene::StartingRub::kNone;
  scene.initial.x = last_of(run, "x");
  scene.initial.y = last_of(run, "y");
  scene.initial.vx = last_of(run, "vx");
  scene.initial.vy = last_of(run, "vy");
  scene.initial.torsion = last_of(run, "torsion");
  scene.initial.torsion_speed = last_of(run, "torsion_speed");
  scene.initial.spin_angle = std::remainder(last("spin_angle"), kTurn);
  if (scene.drive && next.rotor.speed == before.rotor.speed) scene.rotor.speed = last("spin_speed");
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    auto& ring = scene.auxiliary[k].stator;
    if (!ring) continue;
    const auto of = [&](const char* name) { return last(column_of_contact(k, name)); };
    ring->position = {of("stator_x"), of("stator_y")};
    ring->velocity = {of("stator_vx"), of("stator_vy")};
  }
  for (std::size_t i = 0; i < scene.forces.size(); ++i) {
    const scene::Force& was = before.forces[i];
    scene::Force& force = scene.forces[i];
    force.on = was.on - spent;
    if (was.off < scene::kNever) force.off = was.off - spent;
    if (force.kind == scene::ForceKind::kRotating)
      force.phase = std::remainder(was.phase + was.frequency * spent, kTurn);
  }
  return scene;
}

}  // namespace rotorub
