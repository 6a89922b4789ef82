#include "plugin/own/own_space.h"

#include <algorithm>

namespace rotorub::plugin {
namespace {

double damped_step(const mjModel* m) {
  const mjtNum* damping = m->dof_damping;
  const bool any = std::any_of(damping, damping + m->nv, [](mjtNum x) { return x != 0.0; });
  return any && m->opt.integrator != mjINT_RK4 ? m->opt.timestep : 0.0;
}

}  // namespace

Eigen::Vector2d own_position(const Config& config, const mjData* d) {
  const mjtNum* ring = d->geom_xpos + 3 * config.ring_geom;
  const mjtNum* axes = d->geom_xmat + 9 * config.ring_geom;  // columns x, y, z
  const mjtNum* rotor = d->geom_xpos + 3 * config.rotor_geom;
  Eigen::Vector2d p{0.0, 0.0};
  for (int i = 0; i < 3; ++i) {
    p.x() += axes[3 * i] * (rotor[i] - ring[i]);
    p.y() += axes[3 * i + 1] * (rotor[i] - ring[i]);
  }
  return p;
}

ContactPoint own_contact_point(const Config& config, const mjModel* m, mjData* d) {
  const OwnSpace space(config, m, d);
  const Eigen::Vector3d rates = space.rates(d->qvel);
  const ContactParameters& c = *config.model.contact;
  return contact_kinematics(own_position(config, d), rates.head<2>(), rates.z(), c.radius,
                            c.clearance);
}

OwnSpace::OwnSpace(const Config& config, const mjModel* m, mjData* d)
    : m_(m), d_(d), mark_(d->pstack), nv_(m->nv), damped_step_(damped_step(m)) {
  jacobian_ = mj_stackAlloc(d, 3 * nv_);
  mjtNum* move = mj_stackAlloc(d, 3 * nv_);
  mjtNum* turn = mj_stackAlloc(d, 3 * nv_);
  std::fill_n(jacobian_, 3 * nv_, 0.0);
  // Both bodies at the rotor's centre: what the ring's rotation does there is taken off.
  const mjtNum* centre = d->geom_xpos + 3 * config.rotor_geom;
  const mjtNum* axes = d->geom_xmat + 9 * config.ring_geom;
  for (const bool rotor : {true, false}) {
    mj_jac(m, d, move, turn, centre, m->geom_bodyid[rotor ? config.rotor_geom : config.ring_geom]);
    const double sign = rotor ? 1.0 : -1.0;
    for (int i = 0; i < 3; ++i) {
      mju_addToScl(jacobian_, move + i * nv_, sign * axes[3 * i], nv_);
      mju_addToScl(jacobian_ + nv_, move + i * nv_, sign * axes[3 * i + 1], nv_);
      mju_addToScl(jacobian_ + 2 * nv_, turn + i * nv_, sign * axes[3 * i + 2], nv_);
    }
  }
}

void OwnSpace::solve() {
  plain_ = mj_stackAlloc(d_, 3 * nv_);
  mj_solveM(m_, d_, plain_, jacobian_, 3);
  damped_ = plain_;
  if (damped_step_ == 0.0) return;
  damped_ = mj_stackAlloc(d_, 3 * nv_);
  solve_damped();
}

// MuJoCo's sparse factorisation works in mjData: M + h D is put in the place of M, and all put
// back.
void OwnSpace::solve_damped() {
  const int mark = d_->pstack;
  const auto keep = [this](const mjtNum* from, int count) {
    mjtNum* copy = mj_stackAlloc(d_, count);
    std::copy_n(from, count, copy);
    return copy;
  };
  const mjtNum* mass = keep(d_->qM, m_->nM);
  const mjtNum* factor = keep(d_->qLD, m_->nM);
  const mjtNum* inverse = keep(d_->qLDiagInv, nv_);
  const mjtNum* root = keep(d_->qLDiagSqrtInv, nv_);
  for (int i = 0; i < nv_; ++i) {
    d_->qM[m_->dof_Madr[i]] += damped_step_ * m_->dof_damping[i];
  }
  mj_factorM(m_, d_);
  mj_solveM(m_, d_, damped_, jacobian_, 3);
  std::copy_n(mass, m_->nM, d_->qM);
  std::copy_n(factor, m_->nM, d_->qLD);
  std::copy_n(inverse, nv_, d_->qLDiagInv);
  std::copy_n(root, nv_, d_->qLDiagSqrtInv);
  d_->pstack = mark;
}

Eigen::Vector3d OwnSpace::product(const mjtNum* rows, const mjtNum* v) const {
  return {mju_dot(rows, v, nv_), mju_dot(rows + nv_, v, nv_), mju_dot(rows + 2 * nv_, v, nv_)};
}

Eigen::Matrix3d OwnSpace::gram(const mjtNum* rows) const {
  Eigen::Matrix3d g;
  for (int j = 0; j < 3; ++j) g.col(j) = product(rows, jacobian_ + j * nv_);
  return 0.5 * (g + g.transpose());
}

void OwnSpace::add(const mjtNum* rows, const Eigen::Vector3d& load, mjtNum* to) const {
  for (int k = 0; k < 3; ++k) mju_addToScl(to, rows + k * nv_, load[k], nv_);
}

void OwnSpace::add_impact(const Eigen::Vector3d& load, mjtNum* to) const {
  add_load(load, to);
  for (int i = 0; i < nv_; ++i) {
    const double change =
        plain_[i] * load.x() + plain_[nv_ + i] * load.y() + plain_[2 * nv_ + i] * load.z();
    to[i] += damped_step_ * m_->dof_damping[i] * change;
  }
}

}  // namespace rotorub::plugin
