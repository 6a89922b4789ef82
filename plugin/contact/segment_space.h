// The contact of the segment rotor in contact space: (relative x, relative y, spin at the contact)
// = J qdot, J constant for small angles, with MuJoCo's own mass matrix.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>

#include "plugin/config.h"

namespace rotorub::plugin {

// Lives on the stack of mjData for as long as the object does. After mj_factorM of the step.
class SegmentSpace {
 public:
  SegmentSpace(const Config& config, const mjModel* m, mjData* d);
  ~SegmentSpace() { d_->pstack = mark_; }
  SegmentSpace(const SegmentSpace&) = delete;
  SegmentSpace& operator=(const SegmentSpace&) = delete;

  Eigen::Vector3d rates(const mjtNum* v) const { return product(jacobian_, v); }  // J v
  // J H^-1 f, H = M + h D the matrix of the Euler step; `flexibility` is J H^-1 J^T.
  Eigen::Vector3d response(const mjtNum* f) const { return product(damped_, f); }
  Eigen::Matrix3d flexibility() const { return gram(damped_); }
  Eigen::Matrix3d admittance() const { return gram(plain_); }  // J M^-1 J^T

  // to += J^T load (add_load), M^-1 J^T load (add_acceleration)
  void add_load(const Eigen::Vector3d& load, mjtNum* to) const;
  // The same, so that the step's velocities change by h M^-1 J^T load: nothing of it is damped.
  void add_impact(const Eigen::Vector3d& load, mjtNum* to) const;
  void add_acceleration(const Eigen::Vector3d& load, mjtNum* to) const;

 private:
  Eigen::Vector3d product(const mjtNum* rows, const mjtNum* v) const;
  Eigen::Matrix3d gram(const mjtNum* rows) const;
  int ring_dof(int plane) const;
  double damping_factor(int dof) const;
  void add(const mjtNum* rows, const Eigen::Vector3d& load, mjtNum* to) const;

  mjData* d_;
  const mjModel* m_;
  const Config& config_;
  int mark_, nv_;
  mjtNum *jacobian_, *plain_, *damped_;  // 3 x nv: J, (M^-1 J^T)^T, (H^-1 J^T)^T
};

}  // namespace rotorub::plugin
