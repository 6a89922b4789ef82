#include "plugin/contact/chain_space.h"

#include <algorithm>

#include "native_model/dynamics/dynamics.h"
#include "plugin/coordinates.h"
#include "plugin/passive.h"

namespace rotorub::plugin {

ChainSpace::ChainSpace(const Config& config, const mjModel* m, mjData* d, const StepMatrix& matrix)
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
    add_contact_load(model, Eigen::Vector3d::Unit(k), load);
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

}  // namespace rotorub::plugin
