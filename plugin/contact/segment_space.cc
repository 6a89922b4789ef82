#include "plugin/contact/segment_space.h"

#include <algorithm>

namespace rotorub::plugin {

SegmentSpace::SegmentSpace(const Config& config, const mjModel* m, mjData* d)
    : ContactSpace(count(m->nv)), m_(m), config_(config), room_(d) {
  jacobian_ = room_.numbers(3 * nv_);
  plain_ = room_.numbers(3 * nv_);
  damped_ = room_.numbers(3 * nv_);
  std::fill_n(jacobian_, 3 * nv_, 0.0);
  const Segments& s = *config.segments;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    const double u = s.contact_row[static_cast<Eigen::Index>(i)];
    jacobian_[s.x[i].velocity] = u;
    jacobian_[nv_ + s.y[i].velocity] = u;
  }
  jacobian_[2 * nv_ + s.spin[static_cast<std::size_t>(s.contact_node)].velocity] = 1.0;
  const Layout& l = config.model.layout;
  for (int k = 0; k < l.stator; ++k) jacobian_[k * nv_ + ring_dof(l.ring() + k)] = -1.0;
  if (l.ring_spin) jacobian_[2 * nv_ + ring_dof(l.ring_angle())] = -config.model.ring_ratio;
  mj_solveM(m, d, plain_, jacobian_, 3);
  std::copy_n(plain_, 3 * nv_, damped_);
  for (int i = l.ring(); i < l.nq(); ++i) {
    const int dof = ring_dof(i);
    for (int row = 0; row < 3; ++row) damped_[row * nv_ + dof] /= damping_factor(dof);
  }
}

int SegmentSpace::ring_dof(int i) const {
  return config_.dof_address[static_cast<std::size_t>(i)];
}

// H / M. The ring's joints alone have dampers that the step takes implicitly; each stands for
// itself.
double SegmentSpace::damping_factor(int dof) const {
  return 1.0 + damped_step(m_) * m_->dof_damping[dof] / m_->dof_M0[dof];
}

void SegmentSpace::add_impact(const Eigen::Vector3d& load, mjtNum* to) const {
  add_load(load, to);
  const Layout& l = config_.model.layout;
  for (int i = l.ring(); i < l.nq(); ++i) {
    const int dof = ring_dof(i);
    double own = 0.0;
    for (int k = 0; k < 3; ++k) own += jacobian_[k * nv_ + dof] * load[k];
    to[dof] += own * (damping_factor(dof) - 1.0);
  }
}

}  // namespace rotorub::plugin
