#include "plugin/own/own_space.h"

#include <algorithm>
#include <cmath>

namespace rotorub::plugin {
namespace {

double step_of_dampers(const mjModel* m) {
  const mjtNum* damping = m->dof_damping;
  const bool any = std::any_of(damping, damping + m->nv, [](mjtNum x) { return x != 0.0; });
  return any ? damped_step(m) : 0.0;
}

}  // namespace

const mjtNum* contact_axes(const Config& config, const mjData* d) {
  static constexpr mjtNum kWorld[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  return config.own ? d->geom_xmat + 9 * config.ring_geom : kWorld;
}

double held_spin(const Config& config) {
  return config.own || config.model.layout.spin ? 0.0 : config.model.speed;
}

Eigen::Vector2d own_position(const Config& config, const mjData* d) {
  const mjtNum* ring = d->geom_xpos + 3 * config.ring_geom;
  const mjtNum* axes = contact_axes(config, d);
  const mjtNum* rotor = d->geom_xpos + 3 * config.rotor_geom;
  Eigen::Vector2d p{0.0, 0.0};
  for (int i = 0; i < 3; ++i) {
    p.x() += axes[3 * i] * (rotor[i] - ring[i]);
    p.y() += axes[3 * i + 1] * (rotor[i] - ring[i]);
  }
  return p;
}

bool face_each_other(const Config& config, const mjData* d) {
  if (!config.own) return true;
  const mjtNum* ring = d->geom_xpos + 3 * config.ring_geom;
  const mjtNum* rotor = d->geom_xpos + 3 * config.rotor_geom;
  const mjtNum* axes = contact_axes(config, d);
  double along = 0.0;
  for (int i = 0; i < 3; ++i) along += axes[3 * i + 2] * (rotor[i] - ring[i]);
  return std::abs(along) <= config.reach;
}

OwnSpace::OwnSpace(const Config& config, const mjModel* m, mjData* d)
    : ContactSpace(count(m->nv)), m_(m), d_(d), room_(d), damped_step_(step_of_dampers(m)) {
  jacobian_ = room_.numbers(3 * nv_);
  std::fill_n(jacobian_, 3 * nv_, 0.0);
  // Both bodies at the rotor's centre: what the ring's rotation does there is taken off.
  const mjtNum* centre = d->geom_xpos + 3 * config.rotor_geom;
  const mjtNum* axes = contact_axes(config, d);
  const int rotor = m->geom_bodyid[config.rotor_geom], ring = m->geom_bodyid[config.ring_geom];
  add_body(axes, centre, rotor, 1.0);
  add_body(axes, centre, ring, -1.0);
  trees_[0] = tree_of(m, rotor);
  if (m->body_rootid[ring] != m->body_rootid[rotor]) trees_[1] = tree_of(m, ring);
}

// As mj_jac, of the degrees of freedom that move the body alone.
void OwnSpace::add_body(const mjtNum* axes, const mjtNum* centre, int body, double sign) {
  mjtNum arm[3], turn[3];
  mju_sub3(arm, centre, d_->subtree_com + 3 * m_->body_rootid[body]);
  while (body > 0 && m_->body_dofnum[body] == 0) body = m_->body_parentid[body];
  if (body == 0) return;
  for (int i = m_->body_dofadr[body] + m_->body_dofnum[body] - 1; i >= 0; i = m_->dof_parentid[i]) {
    const mjtNum* axis = d_->cdof + 6 * i;  // rotation, then translation at the tree's centre
    mju_cross(turn, axis, arm);
    for (int k = 0; k < 3; ++k) {
      jacobian_[i] += sign * axes[3 * k] * (axis[3 + k] + turn[k]);
      jacobian_[nv_ + i] += sign * axes[3 * k + 1] * (axis[3 + k] + turn[k]);
      jacobian_[2 * nv_ + i] += sign * axes[3 * k + 2] * axis[k];
    }
  }
}

void OwnSpace::solve() {
  plain_ = room_.numbers(3 * nv_);
  solve_rows(d_->qLD, d_->qLDiagInv, plain_);
  damped_ = plain_;
  if (damped_step_ == 0.0) return;
  damped_ = room_.numbers(3 * nv_);
  StackFrame room(d_);
  mjtNum* factor = room.numbers(mass_size(m_));
  mjtNum* inverse = room.numbers(nv_);
  for (const DofRange& tree : trees_) {
    factor_tree(m_, mass_entries(d_), damped_step_, tree, factor, inverse);
  }
  solve_rows(factor, inverse, damped_);
}

void OwnSpace::solve_rows(const mjtNum* factor, const mjtNum* inverse, mjtNum* rows) const {
  std::copy_n(jacobian_, 3 * nv_, rows);
  for (int k = 0; k < 3; ++k) {
    for (const DofRange& tree : trees_) solve_tree(m_, factor, inverse, tree, rows + k * nv_);
  }
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
