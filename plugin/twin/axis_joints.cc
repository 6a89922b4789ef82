#include "plugin/twin/axis_joints.h"

#include <cmath>
#include <numbers>
#include <string>

#include "plugin/message.h"

namespace rotorub::plugin {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kParallel = 1e-9;  // of directions, 1 or m

bool turns(const MatrixXd& jacobian, int dof) { return std::abs(jacobian(5, dof)) > kParallel; }

// A hinge before a slide carries the slide's axis round with it: the machine is no linear one in
// its coordinates.
void refuse_turned_axes(const mjModel* m, int dof, int geom, const std::string& body,
                        Probe& probe) {
  const MatrixXd before = probe.geom_jacobian(geom);
  probe.pose(0.5 * std::numbers::pi * VectorXd::Unit(m->nv, dof));
  const MatrixXd after = probe.geom_jacobian(geom);
  probe.pose(VectorXd::Zero(m->nv));
  for (int i = 0; i < m->nv; ++i) {
    if ((after - before).col(i).cwiseAbs().maxCoeff() <= kParallel) continue;
    refuse(joint_of_dof(m, dof), "turns the axis of " + joint_of_dof(m, i) +
                                     ", for a twin; accepted: a hinge after the " + body +
                                     "'s other joints");
  }
}

AxisJoint find(const mjModel* m, int geom, const std::string& body, Probe& probe) {
  const MatrixXd j = probe.geom_jacobian(geom);
  AxisJoint found;
  for (int i = 0; i < m->nv; ++i) {
    if (!turns(j, i)) continue;
    if (m->jnt_type[m->dof_jntid[i]] != mjJNT_HINGE) {
      refuse(joint_of_dof(m, i),
             "turns the " + body + ", for a twin; accepted: one hinge about its axis");
    }
    const double off = j.col(i).head<2>().norm() + j.col(i).segment<2>(3).norm();
    if (off > kParallel) {
      refuse(joint_of_dof(m, i),
             "turns the " + body +
                 " about another axis than that of the ring's geom through its centre, for a "
                 "twin; accepted: that axis");
    }
    if (found.dof >= 0) {
      refuse(joint_of_dof(m, i),
             "a second joint about the " + body + "'s axis, for a twin; accepted: one");
    }
    found = {i, j(5, i) > 0.0 ? 1.0 : -1.0};
  }
  if (found.dof >= 0) refuse_turned_axes(m, found.dof, geom, body, probe);
  return found;
}

bool moves_with(const mjModel* m, int body, int ancestor) {
  while (body > ancestor) body = m->body_parentid[body];
  return body == ancestor;
}

}  // namespace

AxisJoint find_spin(const mjModel* m, const Config& config, Probe& probe) {
  return find(m, config.rotor_geom, "rotor", probe);
}

AxisJoint find_ring_turn(const mjModel* m, const Config& config, Probe& probe) {
  const AxisJoint found = find(m, config.ring_geom, "ring", probe);
  if (found.dof >= 0 && turns(probe.geom_jacobian(config.rotor_geom), found.dof)) {
    refuse(joint_of_dof(m, found.dof), "turns rotor and ring, for a twin; accepted: one of them");
  }
  return found;
}

std::vector<Eccentricity> find_unbalance(const mjModel* m, const AxisJoint& spin,
                                         const Probe& probe) {
  constexpr double kNone = 1e-12;  // kg m
  std::vector<Eccentricity> all;
  if (spin.dof < 0) return all;
  const int joint = m->dof_jntid[spin.dof], turning = m->dof_bodyid[spin.dof];
  const Eigen::Vector3d anchor = vector3(probe.data()->xanchor + 3 * joint);
  const Eigen::Vector3d axis = vector3(probe.data()->xaxis + 3 * joint);
  for (int body = turning; body < m->nbody; ++body) {
    if (!moves_with(m, body, turning) || m->body_mass[body] == 0.0) continue;
    const Eigen::Vector3d centre = vector3(probe.data()->xipos + 3 * body);
    const Eigen::Vector3d foot = anchor + axis * axis.dot(centre - anchor);
    const Eigen::Vector3d arm = probe.axes() * (centre - foot);
    const double moment = m->body_mass[body] * arm.norm();
    if (moment <= kNone) continue;
    all.push_back(
        {probe.jacobian(foot, turning).topRows<2>(), moment, std::atan2(arm.y(), arm.x())});
  }
  return all;
}

}  // namespace rotorub::plugin
