#include "plugin/contact/segment_space.h"

#include <algorithm>

namespace rotorub::plugin {

SegmentSpace::SegmentSpace(const Config& config, const mjModel* m, mjData* d, const StepMatrix& matrix)
    : ContactSpace(m, d, matrix), room_(d) {
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
  const auto ring = [&](int i) { return config.dof_address[static_cast<std::size_t>(i)]; };
  for (int k = 0; k < l.stator; ++k) jacobian_[k * nv_ + ring(l.ring() + k)] = -1.0;
  if (l.ring_spin) jacobian_[2 * nv_ + ring(l.ring_angle())] = -config.model.ring_ratio;
  trees_[0] = tree_of(m, m->geom_bodyid[config.rotor_geom]);
  trees_[1] = tree_of(m, m->geom_bodyid[config.ring_geom]);
  mj_solveM(m, d, plain_, jacobian_, 3);
  std::copy_n(plain_, 3 * nv_, damped_);
  for (const DofRange& tree : trees_) {
    if (!matrix.differs(tree)) continue;
    for (int k = 0; k < 3; ++k) {
      std::copy(jacobian_ + k * nv_ + tree.first, jacobian_ + k * nv_ + tree.last,
                damped_ + k * nv_ + tree.first);
    }
    matrix.solve(tree, damped_, 3);
  }
}

}  // namespace rotorub::plugin
