#include "plugin/contact/contact_space.h"

#include <algorithm>

#include "native_model/model/dynamics.h"
#include "plugin/model/generated_rotor.h"

namespace rotorub::plugin {

BodySpace::BodySpace(const ContactPair& pair, const ContactPlace& place, const mjModel* m,
                     mjData* d, StepMatrix& matrix, BodyRows rows)
    : ContactSpace(m, d, matrix), m_(m), rows_(rows), room_(d) {
  jacobian_ = room_.numbers(3 * nv_);
  std::fill_n(jacobian_, 3 * nv_, 0.0);
  const int rotor = m->geom_bodyid[pair.rotor_geom], ring = m->geom_bodyid[pair.ring_geom];
  add_body(place.axes, d->geom_xpos + 3 * pair.rotor_geom, rotor, 1.0, 1.0);
  add_body(place.axes, place.ring_point, ring, -1.0, place.ring_spin_factor);
  trees_[0] = tree_of(m, rotor);
  if (m->body_rootid[ring] != m->body_rootid[rotor]) trees_[1] = tree_of(m, ring);
  solve();
}

// Like mj_jac, but only for the degrees of freedom that move the body.
void BodySpace::add_body(const mjtNum* axes, const mjtNum* point, int body, double sign,
                         double spin) {
  const Eigen::Matrix3d to_axes = axes_at(axes).transpose();
  const Eigen::Vector3d arm =
      vector_at(point) - vector_at(d_->subtree_com + 3 * m_->body_rootid[body]);
  for (int i = last_dof(m_, body); i >= 0; i = m_->dof_parentid[i]) {
    // rotation, then translation at the tree's centre of mass
    const auto turn = vector_at(d_->cdof + 6 * i), move = vector_at(d_->cdof + 6 * i + 3);
    const Eigen::Vector3d v = sign * (to_axes * (move + turn.cross(arm)));
    const Eigen::Vector3d omega = sign * spin * (to_axes * turn);
    const bool plane = rows_ == BodyRows::kPlane;
    jacobian_[i] += plane ? v.x() : v.z();
    jacobian_[nv_ + i] += plane ? v.y() : omega.x();
    jacobian_[2 * nv_ + i] += plane ? omega.z() : omega.y();
  }
}

void BodySpace::solve() {
  damped_ = plain_ = room_.numbers(3 * nv_);
  if (!matrix_.differs(trees_[0]) && !matrix_.differs(trees_[1])) {
    plain();
    return;
  }
  damped_ = room_.numbers(3 * nv_);
  std::copy_n(jacobian_, 3 * nv_, damped_);
  for (const DofRange& tree : trees_) matrix_.solve(tree, damped_);
}

void BodySpace::solve_plain() const {
  std::copy_n(jacobian_, 3 * nv_, plain_);
  for (const DofRange& tree : trees_) solve_tree(m_, d_->qLD, d_->qLDiagInv, tree, plain_);
}

ChainSpace::ChainSpace(const Config& config, std::size_t bearing, const mjModel* m, mjData* d,
                       StepMatrix& matrix)
    : ContactSpace(m, d, matrix), config_(config), room_(d) {
  const Model& model = config.model;
  const int nq = model.nq();
  mjtNum** rows[] = {&jacobian_, &plain_, &damped_};
  for (mjtNum** row : rows) {
    *row = room_.numbers(3 * nv_);
    std::fill_n(*row, 3 * nv_, 0.0);
  }
  step_mass_ = room_.numbers(nq);
  step_mass(config, m, step_mass_);
  const Coordinates state(config, d);
  for (int k = 0; k < 3; ++k) {
    double load[kMaxCoordinates], moved[kMaxCoordinates];
    std::fill_n(load, nq, 0.0);
    add_contact_load(model, Eigen::Vector3d::Unit(k), load, bearing);
    add_to_dofs(config, load, jacobian_ + k * nv_);
    solve_mass(model, step_mass_, d->time, state.q(), load, moved);
    add_to_dofs(config, moved, damped_ + k * nv_);
    for (int i = 0; i < nq; ++i) moved[i] = load[i] / model.mass[i];
    add_to_dofs(config, moved, plain_ + k * nv_);
  }
  plain_known_ = true;
}

Eigen::Vector3d ChainSpace::response(const mjtNum* f) const {
  Eigen::Vector3d a(0.0, 0.0, 0.0);
  for (int i = 0; i < config_.model.nq(); ++i) {
    const int dof = config_.dof_address[static_cast<std::size_t>(i)];
    for (int k = 0; k < 3; ++k) a[k] += jacobian_[k * nv_ + dof] * f[dof] / step_mass_[i];
  }
  return a;
}

void ChainSpace::add_load(const Eigen::Vector3d& load, mjtNum* to) const {
  if (!config_.model.coupled_mass()) return add_rows(jacobian_, load, to);
  for (int i = 0; i < config_.model.nq(); ++i) {
    const int dof = config_.dof_address[static_cast<std::size_t>(i)];
    for (int k = 0; k < 3; ++k) to[dof] += step_mass_[i] * damped_[k * nv_ + dof] * load[k];
  }
}

void ChainSpace::add_remainder(const Eigen::Vector3d& normal, const Eigen::Vector3d& friction,
                               mjtNum* to) const {
  if (!config_.model.coupled_mass()) return add_load(friction, to);
  const Eigen::Vector3d whole = normal + friction;
  for (int i = 0; i < config_.model.nq(); ++i) {
    const int dof = config_.dof_address[static_cast<std::size_t>(i)];
    for (int k = 0; k < 3; ++k) {
      const int at = k * nv_ + dof;
      to[dof] += step_mass_[i] * damped_[at] * whole[k] - jacobian_[at] * normal[k];
    }
  }
}

void ChainSpace::add_remainder_acceleration(const Eigen::Vector3d& normal,
                                            const Eigen::Vector3d& friction, mjtNum* to) const {
  StackFrame room(d_);
  mjtNum* load = room.numbers(nv_);
  std::fill_n(load, nv_, 0.0);
  add_remainder(normal, friction, load);
  for (int i = 0; i < config_.model.nq(); ++i) {
    const int dof = config_.dof_address[static_cast<std::size_t>(i)];
    to[dof] += load[dof] / config_.model.mass[i];
  }
}

ContactSpaces::~ContactSpaces() {
  while (count_-- > 0) {
    all_[count_].axial.reset();
    all_[count_].plane.emplace<std::monostate>();
  }
}

ContactSpaces::PairSpaces ContactSpaces::add(const ContactPair& pair, const ContactPlace& place) {
  Spaces& spaces = all_[count_++];
  if (pair.on_chain) {
    return {&spaces.plane.emplace<ChainSpace>(config_, pair.bearing, m_, d_, matrix_), nullptr};
  }
  const BodySpace& plane = spaces.plane.emplace<BodySpace>(pair, place, m_, d_, matrix_);
  if (!pair.axial) return {&plane, nullptr};
  return {&plane, &spaces.axial.emplace(pair, place, m_, d_, matrix_, BodyRows::kAxis)};
}

Eigen::Vector3d ContactRows::column(Eigen::Index k) const {
  if (k == 2) return axial_column(e_r, radius);
  return contact_load(e_r, radius, k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0);
}

ContactMatrix contact_matrix(std::span<const ContactRows* const> contacts, Eigen::Index rows,
                             bool impact) {
  const auto size = rows * static_cast<Eigen::Index>(contacts.size());
  ContactMatrix a = ContactMatrix::Zero(size, size);
  const auto add = [&](std::size_t i, bool at_axis, std::size_t j, bool from_axis) {
    const ContactRows &at = *contacts[i], &from = *contacts[j];
    const ContactSpace* answers = at_axis ? at.axial : at.plane;
    const ContactSpace* loaded = from_axis ? from.axial : from.plane;
    if (!answers || !loaded) return;
    const Eigen::Matrix3d g =
        impact ? answers->admittance(*loaded) : answers->step_admittance(*loaded);
    const Eigen::Index first = at_axis ? 2 : 0, other = from_axis ? 2 : 0;
    const Eigen::Index row = rows * static_cast<Eigen::Index>(i),
                       column = rows * static_cast<Eigen::Index>(j);
    for (Eigen::Index k = other; k < (from_axis ? 3 : 2); ++k) {
      const Eigen::Vector3d rate = g * from.column(k);
      for (Eigen::Index r = first; r < (at_axis ? 3 : 2); ++r) {
        a(row + r, column + k) = at.column(r).dot(rate);
      }
    }
  };
  for (std::size_t j = 0; j < contacts.size(); ++j) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      for (const bool at_axis : {false, true}) {
        for (const bool from_axis : {false, true}) add(i, at_axis, j, from_axis);
      }
    }
  }
  return 0.5 * (a + a.transpose());
}

}  // namespace rotorub::plugin
