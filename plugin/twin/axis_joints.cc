#include "plugin/twin/axis_joints.h"

#include <algorithm>
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

}  // namespace

AxisJoint find_spin(const mjModel* m, const Config& config, Probe& probe) {
  const AxisJoint spin = find(m, config.pairs.front().rotor_geom, "rotor", probe);
  for (const ContactPair& pair : config.pairs) {
    const AxisJoint other = find(m, pair.rotor_geom, "rotor", probe);
    if (other.dof == spin.dof) continue;
    refuse(
        joint_of_dof(m, std::max(other.dof, spin.dof)),
        "turns the rotor of one contact and not that of another, for a twin; accepted: one rotor "
        "in all contacts");
  }
  return spin;
}

AxisJoint find_ring_turn(const mjModel* m, const ContactPair& pair, Probe& probe) {
  const AxisJoint found = find(m, pair.ring_geom, "ring", probe);
  if (found.dof >= 0 && turns(probe.geom_jacobian(pair.rotor_geom), found.dof)) {
    refuse(joint_of_dof(m, found.dof), "turns rotor and ring, for a twin; accepted: one of them");
  }
  return found;
}

}  // namespace rotorub::plugin
