#include "plugin/contact/axial_motion.h"

#include <cmath>

namespace rotorub::plugin {
namespace {

constexpr double kAcross = 1e-6;  // a slide is across the axis: cosine of the angle between

// A frame in the world, where every joint stands as in qpos0.
struct Frame {
  mjtNum position[3] = {0, 0, 0}, rotation[4] = {1, 0, 0, 0};

  Frame then(const mjtNum* pos, const mjtNum* quat) const {
    Frame f;
    at(pos, f.position);
    mju_mulQuat(f.rotation, rotation, quat);
    return f;
  }
  void at(const mjtNum* local, mjtNum* world) const {
    along(local, world);
    mju_addTo3(world, position);
  }
  void along(const mjtNum* local, mjtNum* world) const { mju_rotVecQuat(world, local, rotation); }
};

Frame frame_of(const mjModel* m, int body) {
  if (body == 0) return {};
  return frame_of(m, m->body_parentid[body]).then(m->body_pos + 3 * body, m->body_quat + 4 * body);
}

Frame geom_frame(const mjModel* m, int geom) {
  return frame_of(m, m->geom_bodyid[geom]).then(m->geom_pos + 3 * geom, m->geom_quat + 4 * geom);
}

bool carries(const mjModel* m, int ancestor, int body) {
  while (body > ancestor) body = m->body_parentid[body];
  return body == ancestor;
}

// Whether the joint moves the point along the axis.
bool moves_along(const mjModel* m, int joint, const mjtNum* point, const mjtNum* along,
                 double lever) {
  const int type = m->jnt_type[joint];
  if (type == mjJNT_FREE) return true;
  const Frame body = frame_of(m, m->jnt_bodyid[joint]);
  mjtNum axis[3], anchor[3], arm[3], across[3];
  body.along(m->jnt_axis + 3 * joint, axis);
  if (type == mjJNT_SLIDE) return std::abs(mju_dot3(axis, along)) > kAcross;
  body.at(m->jnt_pos + 3 * joint, anchor);
  mju_sub3(arm, point, anchor);
  mju_cross(across, arm, along);  // along . (axis x arm) = axis . across
  return (type == mjJNT_BALL ? mju_norm3(across) : std::abs(mju_dot3(axis, across))) > lever;
}

}  // namespace

bool lies_across(const mjModel* m, const ContactPair& pair) {
  const int shape = m->geom_type[pair.rotor_geom];
  if (shape != mjGEOM_CYLINDER && shape != mjGEOM_CAPSULE) return false;
  const mjtNum z[3] = {0, 0, 1};
  mjtNum ring[3], rotor[3];
  geom_frame(m, pair.ring_geom).along(z, ring);
  geom_frame(m, pair.rotor_geom).along(z, rotor);
  return std::abs(mju_dot3(ring, rotor)) < 0.5;
}

bool slides_along_axis(const mjModel* m, const ContactPair& pair) {
  if (pair.contact.friction.none()) return false;
  const mjtNum z[3] = {0, 0, 1};
  const Frame ring = geom_frame(m, pair.ring_geom), rotor = geom_frame(m, pair.rotor_geom);
  mjtNum along[3], beside[3], apart[3];
  ring.along(z, along);
  mju_sub3(apart, rotor.position, ring.position);
  mju_addScl3(beside, ring.position, along, mju_dot3(apart, along));
  const int bodies[2] = {m->geom_bodyid[pair.rotor_geom], m->geom_bodyid[pair.ring_geom]};
  for (int i = 0; i < 2; ++i) {
    const mjtNum* point = i == 0 ? rotor.position : beside;
    for (int body = bodies[i]; body > 0; body = m->body_parentid[body]) {
      if (carries(m, body, bodies[1 - i]))
        break;  // what carries both moves neither against the other
      for (int k = 0; k < m->body_jntnum[body]; ++k) {
        const int joint = m->body_jntadr[body] + k;
        if (moves_along(m, joint, point, along, pair.contact.clearance)) return true;
      }
    }
  }
  return false;
}

}  // namespace rotorub::plugin
