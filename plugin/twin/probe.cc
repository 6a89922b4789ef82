#include "plugin/twin/probe.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "plugin/model/message.h"
#include "plugin/model/mujoco_dynamics.h"

namespace rotorub::plugin {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Probe::Probe(const mjModel* m, const Config& config, const mjData* start)
    : m_(m), d_(mj_makeData(m)) {
  if (!d_) throw ConfigError("rotorub: no memory for mjData");
  std::copy_n(start->ctrl, m->nu, d_->ctrl);
  std::copy_n(start->act, m->na, d_->act);
  pose(VectorXd::Zero(m->nv));
  const mjtNum* axes = d_->geom_xmat + 9 * config.pairs.front().ring_geom;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) axes_(i, k) = axes[3 * k + i];
  }
}

void Probe::pose(const VectorXd& q) {
  std::copy_n(m_->qpos0, m_->nq, d_->qpos);
  mj_integratePos(m_, d_->qpos, q.data(), 1.0);
  mj_kinematics(m_, d_.get());
  mj_comPos(m_, d_.get());
  make_mass(m_, d_.get());
  mj_tendon(m_, d_.get());
  mj_transmission(m_, d_.get());
}

MatrixXd Probe::mass() const {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> full(m_->nv, m_->nv);
  full_mass(m_, d_.get(), full.data());
  return full;
}

VectorXd Probe::force(const VectorXd& v) {
  std::copy_n(v.data(), m_->nv, d_->qvel);
  mj_fwdVelocity(m_, d_.get());
  mj_fwdActuation(m_, d_.get());
  VectorXd f(m_->nv);
  for (int i = 0; i < m_->nv; ++i) {
    f[i] = d_->qfrc_passive[i] + d_->qfrc_actuator[i] - d_->qfrc_bias[i];
  }
  return f;
}

Eigen::Vector3d Probe::place(int geom) const {
  const mjtNum* at = d_->geom_xpos + 3 * geom;
  return axes_ * Eigen::Vector3d(at[0], at[1], at[2]);
}

Eigen::Vector2d Probe::apart(const ContactPair& pair) const {
  return (place(pair.rotor_geom) - place(pair.ring_geom)).head<2>();
}

double Probe::along_axis(int geom) const {
  const mjtNum* m = d_->geom_xmat + 9 * geom;
  return axes_.row(2).dot(Eigen::RowVector3d(m[2], m[5], m[8]));
}

MatrixXd Probe::geom_jacobian(int geom) const {
  using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;
  Rows move(3, m_->nv), turn(3, m_->nv);
  mj_jacGeom(m_, d_.get(), move.data(), turn.data(), geom);
  MatrixXd all(6, m_->nv);
  all << axes_ * move, axes_ * turn;
  return all;
}

namespace {

constexpr double kParallel = 1e-9;  // tolerance of directions, 1 or m

bool turns(const MatrixXd& jacobian, int dof) { return std::abs(jacobian(5, dof)) > kParallel; }

// A hinge before a slide turns the slide's axis. The machine is then not linear in its coordinates.
void refuse_turned_axes(const mjModel* m, int dof, int geom, const std::string& body,
                        Probe& probe) {
  const MatrixXd before = probe.geom_jacobian(geom);
  probe.pose(0.5 * std::numbers::pi * VectorXd::Unit(m->nv, dof));
  const MatrixXd after = probe.geom_jacobian(geom);
  probe.pose(VectorXd::Zero(m->nv));
  for (int i = 0; i < m->nv; ++i) {
    if ((after - before).col(i).cwiseAbs().maxCoeff() <= kParallel) continue;
    refuse(joint_of_dof(m, dof), "turns the axis of " + joint_of_dof(m, i) +
                                     "; for `compare` the hinge must come after the " + body +
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
             "is not a hinge; `compare` needs a " + body + " that turns about one hinge");
    }
    const double off = j.col(i).head<2>().norm() + j.col(i).segment<2>(3).norm();
    if (off > kParallel) {
      refuse(
          joint_of_dof(m, i),
          "turns the " + body +
              " about another axis than the z axis of the ring's geom; `compare` needs that axis");
    }
    if (found.dof >= 0) {
      refuse(joint_of_dof(m, i),
             "is a second joint about the " + body + "'s axis; `compare` needs one");
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
    refuse(joint_of_dof(m, std::max(other.dof, spin.dof)),
           "turns the rotor of one contact but not of another; `compare` needs one rotor in all "
           "contacts");
  }
  return spin;
}

AxisJoint find_ring_turn(const mjModel* m, const ContactPair& pair, Probe& probe) {
  const AxisJoint found = find(m, pair.ring_geom, "ring", probe);
  if (found.dof >= 0 && turns(probe.geom_jacobian(pair.rotor_geom), found.dof)) {
    refuse(joint_of_dof(m, found.dof),
           "turns rotor and ring; for `compare` a joint turns one of them");
  }
  return found;
}

}  // namespace rotorub::plugin
