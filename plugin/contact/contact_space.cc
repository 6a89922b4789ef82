#include "plugin/contact/contact_space.h"

#include <algorithm>
#include <cmath>

#include "native_model/model/dynamics.h"
#include "plugin/model/generated_rotor.h"

namespace rotorub::plugin {
namespace {

// The last degree of freedom that moves the body, or -1.
int last_dof(const mjModel* m, int body) {
  while (body > 0 && m->body_dofnum[body] == 0) body = m->body_parentid[body];
  return body == 0 ? -1 : m->body_dofadr[body] + m->body_dofnum[body] - 1;
}

// The vector from `ring` to `rotor` along the contact's axes.
Eigen::Vector3d from_ring(const mjtNum* axes, const mjtNum* rotor, const mjtNum* ring) {
  Eigen::Vector3d p(0.0, 0.0, 0.0);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) p[k] += axes[3 * i + k] * (rotor[i] - ring[i]);
  }
  return p;
}

// The rotor's centre relative to the ring's, m.
Eigen::Vector3d rotor_in_ring(const ContactPair& pair, const mjData* d) {
  return from_ring(contact_axes(pair, d), d->geom_xpos + 3 * pair.rotor_geom,
                   d->geom_xpos + 3 * pair.ring_geom);
}

// Acceleration of a point of a body for qacc = 0, m/s^2: the spatial acceleration (sum of cdof'
// qvel) at the point, and omega x v of the point.
void point_turning(const mjModel* m, const mjData* d, int body, const mjtNum* point, mjtNum* out) {
  mjtNum rate[6] = {0, 0, 0, 0, 0, 0}, arm[3], turn[3], v[3];
  for (int i = last_dof(m, body); i >= 0; i = m->dof_parentid[i]) {
    mju_addToScl(rate, d->cdof_dot + 6 * i, d->qvel[i], 6);
  }
  mju_sub3(arm, point, d->subtree_com + 3 * m->body_rootid[body]);
  const mjtNum* velocity = d->cvel + 6 * body;
  mju_cross(v, velocity, arm);
  mju_addTo3(v, velocity + 3);
  mju_cross(out, velocity, v);
  mju_cross(turn, rate, arm);
  mju_addTo3(out, turn);
  mju_addTo3(out, rate + 3);
}

}  // namespace

const mjtNum* contact_axes(const ContactPair& pair, const mjData* d) {
  static constexpr mjtNum kWorld[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  return pair.in_world ? kWorld : d->geom_xmat + 9 * pair.ring_geom;
}

Eigen::Vector2d position_of(const ContactPair& pair, const mjData* d) {
  return rotor_in_ring(pair, d).head<2>();
}

bool face_each_other(const ContactPair& pair, const mjData* d) {
  return pair.in_world || std::abs(rotor_in_ring(pair, d).z()) <= pair.reach;
}

ContactPlace contact_place(const ContactPair& pair, const mjData* d) {
  ContactPlace place;
  place.axes = contact_axes(pair, d);
  const Eigen::Vector3d centre = rotor_in_ring(pair, d);
  place.d = centre.head<2>();
  place.ring_spin_factor = 1.0 + place.d.norm() / pair.contact.radius;
  const mjtNum* ring = d->geom_xpos + 3 * pair.ring_geom;
  for (int i = 0; i < 3; ++i) place.ring_point[i] = ring[i] + centre.z() * place.axes[3 * i + 2];
  return place;
}

Eigen::Vector2d turning_of(const ContactPair& pair, const ContactPlace& place, const mjModel* m,
                           const mjData* d) {
  if (pair.on_chain) return {0.0, 0.0};
  mjtNum rotor[3], ring[3];
  point_turning(m, d, m->geom_bodyid[pair.rotor_geom], d->geom_xpos + 3 * pair.rotor_geom, rotor);
  point_turning(m, d, m->geom_bodyid[pair.ring_geom], place.ring_point, ring);
  return from_ring(place.axes, rotor, ring).head<2>();
}

BodySpace::BodySpace(const ContactPair& pair, const ContactPlace& place, const mjModel* m,
                     mjData* d, const StepMatrix& matrix, BodyRows rows)
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
  mjtNum arm[3], turn[3];
  mju_sub3(arm, point, d_->subtree_com + 3 * m_->body_rootid[body]);
  for (int i = last_dof(m_, body); i >= 0; i = m_->dof_parentid[i]) {
    // rotation, then translation at the tree's centre of mass
    const mjtNum* axis = d_->cdof + 6 * i;
    mju_cross(turn, axis, arm);
    for (int k = 0; k < 3; ++k) {
      if (rows_ == BodyRows::kAxis) {
        jacobian_[i] += sign * axes[3 * k + 2] * (axis[3 + k] + turn[k]);
        jacobian_[nv_ + i] += sign * spin * axes[3 * k] * axis[k];
        jacobian_[2 * nv_ + i] += sign * spin * axes[3 * k + 1] * axis[k];
        continue;
      }
      jacobian_[i] += sign * axes[3 * k] * (axis[3 + k] + turn[k]);
      jacobian_[nv_ + i] += sign * axes[3 * k + 1] * (axis[3 + k] + turn[k]);
      jacobian_[2 * nv_ + i] += sign * spin * axes[3 * k + 2] * axis[k];
    }
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
  for (const DofRange& tree : trees_) matrix_.solve(tree, damped_, 3);
}

void BodySpace::solve_plain() const {
  std::copy_n(jacobian_, 3 * nv_, plain_);
  for (int k = 0; k < 3; ++k) {
    for (const DofRange& tree : trees_) {
      solve_tree(m_, d_->qLD, d_->qLDiagInv, tree, plain_ + k * nv_);
    }
  }
}

ChainSpace::ChainSpace(const Config& config, std::size_t bearing, const mjModel* m, mjData* d,
                       const StepMatrix& matrix)
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

void ChainSpace::add_side(const Eigen::Vector3d& normal, const Eigen::Vector3d& friction,
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

void ChainSpace::add_side_acceleration(const Eigen::Vector3d& normal,
                                       const Eigen::Vector3d& friction, mjtNum* to) const {
  StackFrame room(d_);
  mjtNum* load = room.numbers(nv_);
  std::fill_n(load, nv_, 0.0);
  add_side(normal, friction, load);
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

ContactSpaces::PairSpaces ContactSpaces::add(const ContactPair& pair) {
  ContactPlace place = contact_place(pair, d_);
  if (pair.further) {
    place.d = separation(config_.model, Coordinates(config_, d_).q(), pair.bearing);
  }
  Spaces& spaces = all_[count_++];
  if (pair.on_chain) {
    return {place, &spaces.plane.emplace<ChainSpace>(config_, pair.bearing, m_, d_, matrix_),
            nullptr};
  }
  const BodySpace& plane = spaces.plane.emplace<BodySpace>(pair, place, m_, d_, matrix_);
  if (!pair.axial) return {place, &plane, nullptr};
  return {place, &plane, &spaces.axial.emplace(pair, place, m_, d_, matrix_, BodyRows::kAxis)};
}

Eigen::Vector3d ContactRows::column(Eigen::Index k) const {
  if (k == 2) return axial_column(e_r, radius);
  return contact_load(e_r, radius, k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0);
}

ContactMatrix contact_matrix(std::span<const ContactRows* const> contacts, Eigen::Index rows,
                             bool impact) {
  const auto first = [rows](std::size_t i) { return rows * static_cast<Eigen::Index>(i); };
  ContactMatrix a = ContactMatrix::Zero(first(contacts.size()), first(contacts.size()));
  for (std::size_t j = 0; j < contacts.size(); ++j) {
    for (Eigen::Index k = 0; k < (contacts[j]->axial ? rows : 2); ++k) {
      const ContactSpace& from = contacts[j]->space(k);
      const Eigen::Vector3d load = contacts[j]->column(k);
      const auto answer = [&](const ContactSpace& at) -> Eigen::Vector3d {
        return (impact ? at.admittance(from) : at.flexibility(from)) * load;
      };
      for (std::size_t i = 0; i < contacts.size(); ++i) {
        a.col(first(j) + k).segment(first(i), rows) = contacts[i]->contact_rates(answer).head(rows);
      }
    }
  }
  return 0.5 * (a + a.transpose());
}

}  // namespace rotorub::plugin
