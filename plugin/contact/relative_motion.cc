#include "plugin/contact/relative_motion.h"

#include <algorithm>
#include <cmath>

#include "plugin/contact/step_matrix.h"
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

// Upper bound of the squared speed of a point for a unit squared speed in the metric of M, 1/kg: by
// the body's own inertia, or, if the body only slides, by the masses of its joints, which on the
// ring of a generated model are all the mass.
double mobility(const mjModel* m, const mjData* d, int geom, const mjtNum* point) {
  const int body = m->geom_bodyid[geom];
  if (m->body_weldid[body] == 0) return 0.0;
  const double arm = (vector_at(point) - vector_at(d->xipos + 3 * body)).squaredNorm();
  const mjtNum* inertia = m->body_inertia + 3 * body;
  const double by_body = 1.0 / m->body_mass[body] +
                         (arm > 0.0 ? arm / std::min({inertia[0], inertia[1], inertia[2]}) : 0.0);
  double by_joints = 0.0;  // |v|^2 <= (sum of mass v_i^2) (sum of 1 / mass)
  for (int i = last_dof(m, body); i >= 0; i = m->dof_parentid[i]) {
    if (m->jnt_type[m->dof_jntid[i]] != mjJNT_SLIDE) return by_body;
    // MuJoCo uses the armature of the last mj_setConst for a dof that it calls simple.
    by_joints += 1.0 / (m->dof_simplenum[i] > 0 ? m->dof_M0[i] : m->dof_armature[i]);
  }
  return std::min(by_body, by_joints);
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

// Acceleration of a point of a body for qacc = 0, m/s^2: the spatial acceleration (sum of cdof'
// qvel) at the point, and omega x v of the point.
Eigen::Vector3d point_turning(const mjModel* m, const mjData* d, int body, const mjtNum* point) {
  Eigen::Vector3d turns(0.0, 0.0, 0.0), moves(0.0, 0.0, 0.0);
  for (int i = last_dof(m, body); i >= 0; i = m->dof_parentid[i]) {
    turns += d->qvel[i] * vector_at(d->cdof_dot + 6 * i);
    moves += d->qvel[i] * vector_at(d->cdof_dot + 6 * i + 3);
  }
  const Eigen::Vector3d arm =
      vector_at(point) - vector_at(d->subtree_com + 3 * m->body_rootid[body]);
  const auto omega = vector_at(d->cvel + 6 * body);
  const Eigen::Vector3d v = vector_at(d->cvel + 6 * body + 3) + omega.cross(arm);
  return omega.cross(v) + turns.cross(arm) + moves;
}

}  // namespace

ContactPlace contact_place(const ContactPair& pair, const mjData* d) {
  static constexpr mjtNum kWorld[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  ContactPlace place;
  place.axes = pair.in_world ? kWorld : d->geom_xmat + 9 * pair.ring_geom;
  const auto ring = vector_at(d->geom_xpos + 3 * pair.ring_geom);
  const auto axes = axes_at(place.axes);
  const Eigen::Vector3d apart = vector_at(d->geom_xpos + 3 * pair.rotor_geom) - ring;
  const Eigen::Vector3d centre = axes.transpose() * apart;
  place.d = centre.head<2>();
  place.along = centre.z();
  place.ring_spin_factor = 1.0 + place.d.norm() / pair.contact.radius;
  for (int i = 0; i < 3; ++i) place.ring_point[i] = ring[i] + centre.z() * axes(i, 2);
  return place;
}

ContactPoint contact_point_of(const ContactPair& pair, const mjModel* m, const mjData* d) {
  return PairMotion(pair, m, d).point();
}

const ContactPlace& PairMotion::place() {
  if (!place_) place_ = contact_place(*pair_, d_);
  return *place_;
}

// J qvel from MuJoCo's body velocities: rotation, then translation of the body's point at its
// tree's centre of mass.
const Eigen::Vector3d& PairMotion::rates() {
  if (rates_) return *rates_;
  const auto velocity = [this](int geom, const mjtNum* point, double spin) {
    const int body = m_->geom_bodyid[geom];
    const auto omega = vector_at(d_->cvel + 6 * body), v = vector_at(d_->cvel + 6 * body + 3);
    const Eigen::Vector3d arm =
        vector_at(point) - vector_at(d_->subtree_com + 3 * m_->body_rootid[body]);
    const auto axes = axes_at(place().axes);
    const Eigen::Vector3d moves = axes.transpose() * (v + omega.cross(arm));
    return Eigen::Vector3d(moves.x(), moves.y(), spin * axes.col(2).dot(omega));
  };
  rates_ = velocity(pair_->rotor_geom, d_->geom_xpos + 3 * pair_->rotor_geom, 1.0) -
           velocity(pair_->ring_geom, place().ring_point, place().ring_spin_factor);
  return *rates_;
}

ContactPoint PairMotion::point() {
  return contact_kinematics(place().d, rates().head<2>(), rates().z(), pair_->contact.radius,
                            pair_->contact.clearance);
}

const Eigen::Vector2d& PairMotion::turning() {
  if (turning_) return *turning_;
  if (pair_->on_chain) return turning_.emplace(0.0, 0.0);
  const int rotor = pair_->rotor_geom;
  const Eigen::Vector3d apart =
      point_turning(m_, d_, m_->geom_bodyid[rotor], d_->geom_xpos + 3 * rotor) -
      point_turning(m_, d_, m_->geom_bodyid[pair_->ring_geom], place().ring_point);
  return turning_.emplace((axes_at(place().axes).transpose() * apart).head<2>());
}

bool Reach::may_reach(const ContactPair& pair, PairMotion& motion) {
  const double h = m_->opt.timestep;
  const double gap = pair.contact.clearance - motion.place().d.norm();
  const double speed = motion.rates().head<2>().norm();
  if (!(gap > h * speed)) return true;
  if (change_ < 0.0) change_ = change(m_, d_);
  const double mobile = mobility(m_, d_, pair.rotor_geom, d_->geom_xpos + 3 * pair.rotor_geom) +
                        mobility(m_, d_, pair.ring_geom, motion.place().ring_point);
  return !(gap > h * (speed + h * std::sqrt(mobile) * change_));
}

}  // namespace rotorub::plugin
