#include "tests/bench/peers/planar_scene.h"

#include <fmt/format.h>

#include <stdexcept>

#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"

namespace rotorub::peers {
namespace {

// The first part that a planar system of one mode cannot represent; empty if there is none.
std::string beyond(const scene::Scene& s, const Model& m) {
  if (m.layout.modes != 1) return fmt::format("{} bending modes in a plane", m.layout.modes);
  if (!s.first().contact) return "a scene without [contact]";
  if (s.auxiliary.size() > 1) return "several contacts";
  if (s.gravity) return "[gravity]";
  if (s.base) return "[base]";
  if (!m.first().ring_offset.isZero(0.0)) return "contact.offset";
  if (m.layout.torsion > 0) return "elastic torsion";
  if (m.layout.ring_spin > 0) return "a ring that turns ([stator.spin])";
  if (m.is_compliant()) return "a contact that gives ([contact.compliance])";
  if (!m.supports.empty()) return "a ring on more than its spring and damper";
  if (!m.gyroscopic.absent()) return "gyroscopic terms";
  if (!m.internal_xx.absent() || !m.internal_xy.absent()) return "internal (rotating) damping";
  if (m.weight.size() > 0) return "a bearing that stands off the line";
  if (!m.dampers.empty() || !m.springs.empty() || !m.feedbacks.empty() || !m.films.empty())
    return "bearings or springs at stations of their own";
  if (!m.unbalances.empty()) return "unbalance";
  for (const AppliedForce& f : m.forces) {
    if (f.kind != scene::ForceKind::kRotating && f.kind != scene::ForceKind::kConstant) {
      return "a [[force]] that is neither rotating nor constant";
    }
  }
  if (m.first().controller || m.first().magnets || s.first().actuator)
    return "[controller] or [actuator]";
  if (s.drive && s.drive->kind != scene::DriveKind::kLinear &&
      s.drive->kind != scene::DriveKind::kFree) {
    return "a [drive] that is not linear";
  }
  if (s.first().contact->tangential_restitution != 0.0) return "contact.tangential_restitution";
  if (s.first().contact->compression_time != 0.0 || s.first().contact->expansion_time != 0.0) {
    return "contact.compression_time or contact.expansion_time";
  }
  return "";
}

PlanarSupport support(const Model& m, int x, int y) {
  return {{m.mass[x], m.mass[y]}, {m.damping[x], m.damping[y]}, {m.stiffness[x], m.stiffness[y]}};
}

PlanarLoad planar(const AppliedForce& f) {
  PlanarLoad l;
  l.rotating = f.kind == scene::ForceKind::kRotating;
  // One mode, 1 at the contact: its value where the force acts scales the force.
  const double at = f.shape.x[0];
  l.amplitude = at * f.amplitude;
  l.frequency = f.frequency;
  l.phase = f.phase;
  l.vector = {at * f.vector.x(), at * f.vector.y()};
  l.on = f.on;
  l.off = f.off;
  l.ramp = f.ramp;
  return l;
}

}  // namespace

PlanarSystem planar_system(const scene::Scene& scene) {
  const Model m = prepare(scene);
  const std::string part = beyond(scene, m);
  if (!part.empty()) {
    throw std::runtime_error(
        fmt::format("{}: {}: expected a rotor of one mode in each plane, a ring, a linear drive or "
                    "a held spin, and forces",
                    scene.name, part));
  }
  const Layout& l = m.layout;
  PlanarSystem s;
  s.rotor = support(m, l.x(), l.y());
  s.ring_moves = l.stator > 0;
  s.position = {m.q0[l.x()], m.q0[l.y()]};
  s.velocity = {m.v0[l.x()], m.v0[l.y()]};
  if (s.ring_moves) {
    s.ring = support(m, l.ring(), l.ring() + 1);
    s.ring_position = {m.q0[l.ring()], m.q0[l.ring() + 1]};
    s.ring_velocity = {m.v0[l.ring()], m.v0[l.ring() + 1]};
  }
  s.angle = m.spin_angle;
  s.speed = m.speed;
  s.spin_is_free = l.spin > 0;
  if (s.spin_is_free) {
    s.inertia = m.mass[l.phi()];
    const bool linear = scene.drive->kind == scene::DriveKind::kLinear;
    s.drive_gain = linear ? scene.drive->gain : 0.0;
    s.drive_speed = scene.drive->speed;
  }
  for (const AppliedForce& f : m.forces) s.loads.push_back(planar(f));
  s.radius = m.first().contact->radius;
  s.clearance = m.first().contact->clearance;
  s.friction = m.first().contact->friction.constant("the other engines");
  s.restitution = m.first().contact->restitution;
  return s;
}

}  // namespace rotorub::peers
