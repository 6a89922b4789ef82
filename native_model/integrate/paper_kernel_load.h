// Filling a PaperKernel from models, lane by lane.
#pragma once

#include <cassert>

#include "native_model/integrate/gyroscopic_modes.h"
#include "native_model/integrate/paper_kernel.h"

namespace rotorub {

template <class T>
PaperKernel<T>::PaperKernel(const std::vector<const Model*>& models, double step)
    : step_(step), layout_(models.front()->layout), models_(models) {
  assert(models.size() == static_cast<std::size_t>(kLanes));
  const Model& first = *models.front();
  contact_present_ = first.contact.has_value();
  coupled_ = first.coupled_mass();
  commanded = layout_.stator && first.controller;
  magnets_ = first.magnets.has_value();
  const auto n = static_cast<std::size_t>(layout_.nq());
  for (auto* x : {&q_, &v_, &q_mid_, &v_new_, &f_, &mass_, &inverse_mass_, &implicit_inverse_,
                  &stiffness_, &damping_}) {
    x->assign(n, T{});
  }
  if (first.weight.size() > 0) weight_.assign(n, T{});
  load(models);
}

template <class T>
void PaperKernel<T>::load(const std::vector<const Model*>& models) {
  using lanes::set;
  const Model& first = *models.front();
  const auto n = static_cast<std::size_t>(layout_.modes);
  const auto resize = [](lanes::Array<T>& to, std::size_t size) { to.assign(size, T{}); };
  const auto put = [&](lanes::Array<T>& to, const Eigen::VectorXd& from, int lane) {
    for (Eigen::Index i = 0; i < from.size(); ++i) {
      set(to[static_cast<std::size_t>(i)], lane, from[i]);
    }
  };
  const auto put_matrix = [&](lanes::Array<T>& to, const Eigen::MatrixXd& from, int lane) {
    for (Eigen::Index i = 0; i < from.rows(); ++i) {
      for (Eigen::Index j = 0; j < from.cols(); ++j) {
        set(to[static_cast<std::size_t>(i * from.cols() + j)], lane, from(i, j));
      }
    }
  };

  resize(contact_x_, n);
  resize(contact_y_, n);
  resize(torsion_contact_, static_cast<std::size_t>(layout_.torsion));
  resize(drive_shape_, static_cast<std::size_t>(layout_.torsion));
  if (coupled_) {
    resize(arm_x_, n);
    resize(arm_y_, n);
  }
  forces_.resize(first.forces.size());
  springs_.resize(first.springs.size());
  dampers_.resize(first.dampers.size());
  unbalances_.resize(first.unbalances.size());
  for (Matrix* m : {&internal_xx_, &internal_yy_, &internal_xy_}) m->a.assign(n * n, T{});

  for (int lane = 0; lane < kLanes; ++lane) {
    const Model& m = *models[static_cast<std::size_t>(lane)];
    put(q_, m.q0, lane);
    put(v_, m.v0, lane);
    put(mass_, m.mass, lane);
    put(stiffness_, m.stiffness, lane);
    put(damping_, m.damping, lane);
    if (!weight_.empty()) put(weight_, m.weight, lane);
    put(contact_x_, m.contact_shape.x, lane);
    put(contact_y_, m.contact_shape.y, lane);
    put(torsion_contact_, m.torsion_contact, lane);
    put(drive_shape_, m.drive_shape, lane);
    set(speed_, lane, m.speed);
    set(spin_angle_, lane, m.spin_angle);
    if (m.contact) {
      set(radius_, lane, m.contact->radius);
      set(clearance_, lane, m.contact->clearance);
      set(friction_, lane, m.contact->friction);
      set(restitution_, lane, m.contact->restitution);
    }
    if (m.drive) {
      drive_kind_ = m.drive->kind();
      set(drive_gain_, lane, -m.drive->slope(0.0));
      set(drive_speed_, lane, m.drive->kind() == scene::DriveKind::kLinear ? m.drive->target() : 0.0);
    }
    for (std::size_t i = 0; i < forces_.size(); ++i) {
      const AppliedForce& from = m.forces[i];
      Force& to = forces_[i];
      to.rotating = from.kind == scene::ForceKind::kRotating;
      to.switched = to.switched || from.on > 0.0 || from.off < scene::kNever || from.ramp > 0.0;
      to.shape_x.resize(n);
      to.shape_y.resize(n);
      set(to.amplitude, lane, from.amplitude);
      set(to.frequency, lane, from.frequency);
      set(to.phase, lane, from.phase);
      set(to.x, lane, from.vector.x());
      set(to.y, lane, from.vector.y());
      set(to.on, lane, from.on);
      set(to.off, lane, from.off);
      set(to.ramp, lane, from.ramp);
      set(to.turn_cosine, lane, std::cos(from.frequency * step_));
      set(to.turn_sine, lane, std::sin(from.frequency * step_));
      put(to.shape_x, from.shape.x, lane);
      put(to.shape_y, from.shape.y, lane);
    }
    const auto station = [&](Station& to, const Eigen::Vector2d& factor, const ModeShape& shape) {
      to.shape_x.resize(n);
      to.shape_y.resize(n);
      set(to.factor_x, lane, factor.x());
      set(to.factor_y, lane, factor.y());
      put(to.shape_x, shape.x, lane);
      put(to.shape_y, shape.y, lane);
    };
    for (std::size_t i = 0; i < springs_.size(); ++i) {
      station(springs_[i], m.springs[i].stiffness, m.springs[i].shape);
    }
    for (std::size_t i = 0; i < dampers_.size(); ++i) {
      station(dampers_[i], m.dampers[i].damping, m.dampers[i].shape);
    }
    for (std::size_t i = 0; i < unbalances_.size(); ++i) {
      Unbalance& to = unbalances_[i];
      to.shape_x.resize(n);
      to.shape_y.resize(n);
      set(to.moment, lane, m.unbalances[i].static_moment);
      set(to.phase, lane, m.unbalances[i].phase);
      put(to.shape_x, m.unbalances[i].shape.x, lane);
      put(to.shape_y, m.unbalances[i].shape.y, lane);
    }
    const auto matrix = [&](Matrix& to, const ModeMatrix& from) {
      to.kind = std::max(to.kind, from.kind());
      put_matrix(to.a, from.dense(layout_.modes), lane);
    };
    matrix(internal_xx_, m.internal_xx);
    matrix(internal_yy_, m.internal_yy);
    matrix(internal_xy_, m.internal_xy);

    const GyroscopicModes g = gyroscopic_modes(m);
    if (g.rate.size() > 0) {
      if (!rotates_) {
        rotates_ = rotates_diagonal_ = true;
        resize(turn_rate_, n);
        resize(pair_a_, n);
        resize(pair_b_, n);
        for (auto* x : {&to_x_, &to_y_, &from_x_, &from_y_}) resize(*x, n * n);
      }
      rotates_diagonal_ = rotates_diagonal_ && g.diagonal;
      put(turn_rate_, g.rate, lane);
      put_matrix(to_x_, g.to_x, lane);
      put_matrix(to_y_, g.to_y, lane);
      put_matrix(from_x_, g.from_x, lane);
      put_matrix(from_y_, g.from_y, lane);
    }
  }
  const T one = lanes::all<T>(1.0), half = lanes::all<T>(0.5 * step_);
  for (std::size_t i = 0; i < mass_.size(); ++i) {
    inverse_mass_[i] = one / mass_[i];
    T implicit = mass_[i] + half * damping_[i];
    // A linear drive falls with the speed: implicit as damping is.
    const bool spin = layout_.spin && i == static_cast<std::size_t>(layout_.phi());
    if (spin && drive_kind_ == scene::DriveKind::kLinear) implicit += half * drive_gain_;
    implicit_inverse_[i] = one / implicit;
  }
  if (!coupled_) {
    constant_ = admittance(inverse_mass_.data());
    constant_implicit_ = admittance(implicit_inverse_.data());
  }
}

}  // namespace rotorub
