#include "plugin/contact/reach.h"

#include <algorithm>
#include <cmath>

#include "plugin/contact/body_space.h"
#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {
namespace {

// Squared speed of a point per squared speed in the metric of M: an upper bound, 1/kg.
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

// What loads and constraints change, per second, in the metric of M.
double change(const mjModel* m, mjData* d) {
  const int nv = count(m->nv), n = d->nefc;
  StackFrame room(d);
  mjtNum* x = room.numbers(nv);
  double change = 0.0;
  if (n == 0) {
    half_solve(m, d, x, d->qfrc_smooth, room);
    change = mju_norm(x, nv);
  } else {
    mj_solveM(m, d, x, d->qfrc_smooth, 1);
    mjtNum* miss = room.numbers(n);
    mj_mulJacVec(m, d, miss, x);
    double cost = 0.0;
    for (int i = 0; i < n; ++i) {
      const double e = miss[i] - d->efc_aref[i];
      cost += d->efc_D[i] * e * e;
    }
    change = std::sqrt(std::max(0.0, mju_dot(x, d->qfrc_smooth, nv))) + std::sqrt(cost);
  }
  return change;
}

}  // namespace

Eigen::Vector3d rates_of(const ContactPair& pair, const ContactPlace& place, const mjModel* m,
                         const mjData* d) {
  Eigen::Vector3d rates(0.0, 0.0, 0.0);
  const auto add = [&](int body, const mjtNum* point, double sign, double spin) {
    // Rotation, then translation of the point of the body at its tree's centre of mass.
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
  add(m->geom_bodyid[pair.ring_geom], place.ring_point, -1.0, place.ring_spin);
  return rates;
}

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
