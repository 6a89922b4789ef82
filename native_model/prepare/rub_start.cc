#include "native_model/prepare/rub_start.h"

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <optional>
#include <string>

#include "native_model/linear/rub_map.h"
#include "native_model/linear/rub_system.h"
#include "native_model/prepare/periodic_start.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/record.h"
#include "native_model/scene/text.h"

namespace rotorub::rub {
namespace {

constexpr const char* kKey = "initial.rub";

RubKind kind_of(scene::StartingRub rub) {
  if (rub == scene::StartingRub::kSynchronous) return RubKind::kForced;
  return rub == scene::StartingRub::kWhip ? RubKind::kWhip : RubKind::kRolling;
}

// "synchronous rub", "whip", "rolling".
std::string name_of(RubKind kind) {
  return kind == RubKind::kForced ? "synchronous rub" : to_string(kind);
}

// Removes a force that has not begun at t = 0 or has ended; refuses one that is still rising.
void leave_out_later(const scene::Scene& scene, std::size_t number, scene::Force& force) {
  const bool risen = force.on <= 0.0 && force.on + force.ramp <= 0.0;
  if (risen && force.off > 0.0) return;
  if (force.on < 0.0 && force.off > 0.0) {
    scene::refuse_at(scene, scene::list_element("force", number) + ".ramp",
                     "is still rising at t = 0, so no rub lasts; with initial.rub let the force "
                     "begin to rise at 0 or later, or end its rise by then");
  }
  force.kind = scene::ForceKind::kRotating;
  force.amplitude = 0.0;
}

// The scene with the loads and controllers of t = 0, as if they acted for ever.
scene::Scene at_start(scene::Scene scene) {
  const scene::Scene given = scene;
  for (std::size_t k = 0; k < scene.forces.size(); ++k) leave_out_later(given, k, scene.forces[k]);
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    std::optional<scene::Controller>& controller = scene.auxiliary[k].controller;
    if (!controller) continue;
    if (controller->on > 0.0) {
      controller.reset();
    } else if (controller->kind == scene::ControllerKind::kTwoPhase) {
      scene::refuse_at(given, k, "controller.kind",
                       "the rub under the first phase of two_phase is unknown; with initial.rub "
                       "choose passive or cross_coupled");
    }
  }
  return scene;
}

// Names the forces that `modes` counts but a start does not.
std::string begins_later(const scene::Scene& scene) {
  std::string later;
  for (std::size_t k = 0; k < scene.forces.size(); ++k) {
    if (scene.forces[k].on <= 0.0) continue;
    later += (later.empty() ? "" : ", ") + scene::list_element("force", k);
  }
  return later.empty() ? "" : " under what acts at t = 0 (" + later + " begins later)";
}

SteadyRub rub_of(const scene::Scene& scene, const RubSystem& system) {
  const RubKind kind = kind_of(scene.initial.rub);
  if (kind == RubKind::kForced && rotating_loads(system).size() > 1) {
    scene::refuse_at(scene, kKey,
                     "under loads of several frequencies there is no synchronous rub; keep the "
                     "loads of one frequency at t = 0, or choose whip or rolling");
  }
  const RubPoint point = RubStudy(system).at(system.friction);
  if (const StandingRub* found = point.leading(kind)) return found->rub;
  std::string others;
  for (const RubKind other : {RubKind::kForced, RubKind::kWhip, RubKind::kRolling}) {
    if (point.leading(other)) others += (others.empty() ? "" : ", ") + name_of(other);
  }
  scene::refuse_at(scene, kKey,
                   "there is no " + name_of(kind) + " at " + scene::number_text(system.speed) +
                       " rad/s" + begins_later(scene) + "; choose " +
                       (others.empty() ? "" : "one that exists here (" + others + "), or ") +
                       "none");
}

void put(const Complex& place, double whirl, Model& model, int x, int y) {
  const Complex velocity = kI * whirl * place;
  model.q0[x] = place.real();
  model.q0[y] = place.imag();
  model.v0[x] = velocity.real();
  model.v0[y] = velocity.imag();
}

// Sets the twist by the motor at one station and by friction at another.
void twist(const SteadyRub& rub, Model& m) {
  const Layout& l = m.layout;
  const AuxiliaryBearing& at = m.first();
  const double friction = at.contact->radius * rub.friction * rub.normal_force;
  Eigen::VectorXd torque = -friction * at.torsion_shape;
  if (m.drive) torque += m.drive->torque(0.0, 0.0, m.speed) * m.drive_shape;
  m.q0.segment(l.theta(), l.torsion) =
      torque.cwiseQuotient(m.stiffness.segment(l.theta(), l.torsion));
}

// Refuses a ring whose speed is given.
void check_ring_spin(const scene::Scene& scene) {
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const auto& ring = scene.auxiliary[k].stator;
    if (!ring || !ring->spin || ring->spin->speed == 0.0) continue;
    scene::refuse_at(scene, k, "stator.spin.speed",
                     "the rub determines the speed of the ring; with initial.rub remove this key");
  }
}

void put(const scene::Scene& scene, const RubSystem& system, Model& m) {
  const SteadyRub rub = rub_of(scene, system);
  const Complex direction = std::polar(1.0, rub.direction);
  const Layout& l = m.layout;
  for (int k = 0; k < l.modes; ++k) {
    put(direction * rub.rotor[k], rub.whirl, m, l.x() + k, l.y() + k);
  }
  const AuxiliaryBearing& at = m.first();
  if (at.moves()) put(direction * rub.ring, rub.whirl, m, at.ring, at.ring + 1);
  if (at.turns()) m.v0[at.ring_angle] = rub.ring_speed;
  if (l.torsion > 0 && scene.initial.torsion.empty()) twist(rub, m);
}

}  // namespace

void put_on_closed_form(const scene::Scene& scene, Model& m) {
  check_ring_spin(scene);
  put(scene, rub_system(at_start(scene)), m);
}

void add_rub_start(const scene::Scene& scene, Model& m) {
  check_ring_spin(scene);
  const scene::Scene acting = at_start(scene);
  RubSystem system;
  std::optional<scene::SceneError> no_form;
  try {
    system = rub_system(acting);
  } catch (const scene::SceneError& error) {
    no_form = error;
  }
  if (!no_form) return put(scene, system, m);
  const State state = state_on_periodic_rub(acting, *no_form);
  if (state.q.size() != m.nq()) throw *no_form;
  m.q0 = state.q;
  m.v0 = state.v;
}

}  // namespace rotorub::rub
