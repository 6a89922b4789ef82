#include "plugin/twin/probe.h"

#include <algorithm>

#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Probe::Probe(const mjModel* m, const Config& config, const mjData* start)
    : m_(m), d_(mj_makeData(m)) {
  if (!d_) throw ConfigError("rotorub: no memory for mjData");
  std::copy_n(start->ctrl, m->nu, d_->ctrl);
  std::copy_n(start->act, m->na, d_->act);
  pose(VectorXd::Zero(m->nv));
  const mjtNum* axes = d_->geom_xmat + 9 * config.ring_geom;
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

Eigen::Vector3d Probe::place(int geom) const { return axes_ * vector3(d_->geom_xpos + 3 * geom); }

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

}  // namespace rotorub::plugin
