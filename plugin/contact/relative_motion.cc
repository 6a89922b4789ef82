#include "plugin/contact/relative_motion.h"

#include <algorithm>
#include <cmath>

#include "plugin/contact/contact_space.h"
#include "plugin/model/mujoco_dynamics.h"

namespace rotorub::plugin {
namespace {

constexpr double kAcross = 1e-6;  // cosine of the angle below which a slide is normal to the axis

// A frame in the world with every joint as at qpos0.
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

// True if the joint moves the point along the axis.
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
  if (pair.contact.friction.is_frictionless()) return false;
  const mjtNum z[3] = {0, 0, 1};
  const Frame ring = geom_frame(m, pair.ring_geom), rotor = geom_frame(m, pair.rotor_geom);
  mjtNum along[3], nearest[3], apart[3];
  ring.along(z, along);
  mju_sub3(apart, rotor.position, ring.position);
  mju_addScl3(nearest, ring.position, along, mju_dot3(apart, along));
  const int bodies[2] = {m->geom_bodyid[pair.rotor_geom], m->geom_bodyid[pair.ring_geom]};
  for (int i = 0; i < 2; ++i) {
    const mjtNum* point = i == 0 ? rotor.position : nearest;
    for (int body = bodies[i]; body > 0; body = m->body_parentid[body]) {
      if (carries(m, body, bodies[1 - i]))
        break;  // a body that carries both does not move one against the other
      for (int k = 0; k < m->body_jntnum[body]; ++k) {
        const int joint = m->body_jntadr[body] + k;
        if (moves_along(m, joint, point, along, pair.contact.clearance)) return true;
      }
    }
  }
  return false;
}

namespace {

// Upper bound of the squared speed of a point for a unit squared speed in the metric of M, 1/kg.
double mobility(const mjModel* m, const mjData* d, int geom, const mjtNum* point) {
  const int body = m->geom_bodyid[geom];
  if (m->body_weldid[body] == 0) return 0.0;
  const mjtNum* centre = d->xipos + 3 * body;
  double arm = 0.0;
  for (int i = 0; i < 3; ++i) arm += (point[i] - centre[i]) * (point[i] - centre[i]);
  const mjtNum* inertia = m->body_inertia + 3 * body;
  return 1.0 / m->body_mass[body] +
         (arm > 0.0 ? arm / std::min({inertia[0], inertia[1], inertia[2]}) : 0.0);
}

// The change of the velocities by loads and constraints per second, in the metric of M.
double change(const mjModel* m, mjData* d) {
  const int nv = count(m->nv), n = d->nefc;
  StackFrame room(d);
  mjtNum* x = room.numbers(nv);
  if (n == 0) {
    half_solve(m, d, x, d->qfrc_smooth, room);
    return mju_norm(x, nv);
  }
  mj_solveM(m, d, x, d->qfrc_smooth, 1);
  mjtNum* miss = room.numbers(n);
  mj_mulJacVec(m, d, miss, x);
  double cost = 0.0;
  for (int i = 0; i < n; ++i) {
    const double e = miss[i] - d->efc_aref[i];
    cost += d->efc_D[i] * e * e;
  }
  return std::sqrt(std::max(0.0, mju_dot(x, d->qfrc_smooth, nv))) + std::sqrt(cost);
}

// Rates of the rotor's centre seen from the ring, (relative x, relative y, spin) as in a BodySpace:
// J qvel from MuJoCo's body velocities. Call it after MuJoCo's velocity stage.
Eigen::Vector3d rates_of(const ContactPair& pair, const ContactPlace& place, const mjModel* m,
                         const mjData* d) {
  Eigen::Vector3d rates(0.0, 0.0, 0.0);
  const auto add = [&](int body, const mjtNum* point, double sign, double spin) {
    // Rotation, then translation of the body's point at its tree's centre of mass.
    const mjtNum* velocity = d->cvel + 6 * body;
    mjtNum arm[3], move[3];
    mju_sub3(arm, point, d->subtree_com + 3 * m->body_rootid[body]);
    mju_cross(move, velocity, arm);
    for (int i = 0; i < 3; ++i) {
      const double v = sign * (velocity[3 + i] + move[i]);
      rates.x() += place.axes[3 * i] * v;
      rates.y() += place.axes[3 * i + 1] * v;
      rates.z() += place.axes[3 * i + 2] * sign * spin * velocity[i];
    }
  };
  add(m->geom_bodyid[pair.rotor_geom], d->geom_xpos + 3 * pair.rotor_geom, 1.0, 1.0);
  add(m->geom_bodyid[pair.ring_geom], place.ring_point, -1.0, place.ring_spin_factor);
  return rates;
}

}  // namespace

ContactPoint contact_point_of(const ContactPair& pair, const mjModel* m, const mjData* d) {
  const ContactPlace place = contact_place(pair, d);
  const Eigen::Vector3d rates = rates_of(pair, place, m, d);
  return contact_kinematics(place.d, rates.head<2>(), rates.z(), pair.contact.radius,
                            pair.contact.clearance);
}

bool Reach::may_reach(const ContactPair& pair) {
  const double h = m_->opt.timestep;
  const ContactPlace place = contact_place(pair, d_);
  const double gap = pair.contact.clearance - place.d.norm();
  const double speed = rates_of(pair, place, m_, d_).head<2>().norm();
  if (!(gap > h * speed)) return true;
  if (change_ < 0.0) change_ = change(m_, d_);
  const double mobile = mobility(m_, d_, pair.rotor_geom, d_->geom_xpos + 3 * pair.rotor_geom) +
                        mobility(m_, d_, pair.ring_geom, place.ring_point);
  return !(gap > h * (speed + h * std::sqrt(mobile) * change_));
}

}  // namespace rotorub::plugin
