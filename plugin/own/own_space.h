// The contact of a user's own model in contact space: (relative x, relative y, spin) = J qvel in
// the frame of the ring's geom, z its axis, with MuJoCo's own Jacobians and mass matrix. The rotor
// is seen from the ring, which may move, tilt and turn.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>

#include "native_model/contact/kinematics.h"
#include "plugin/config.h"

namespace rotorub::plugin {

// Where the rotor's centre is in the ring, m.
Eigen::Vector2d own_position(const Config& config, const mjData* d);
// Gap, rates and slip of the state.
ContactPoint own_contact_point(const Config& config, const mjModel* m, mjData* d);

// Lives on the stack of mjData for as long as the object does.
class OwnSpace {
 public:
  OwnSpace(const Config& config, const mjModel* m, mjData* d);
  ~OwnSpace() { d_->pstack = mark_; }
  OwnSpace(const OwnSpace&) = delete;
  OwnSpace& operator=(const OwnSpace&) = delete;

  Eigen::Vector3d rates(const mjtNum* v) const { return product(jacobian_, v); }  // J v

  // Solves for the below; needed once, before them. H = M + h D is the matrix of the Euler step,
  // near that of `implicit`; M alone for RK4.
  void solve();
  Eigen::Vector3d response(const mjtNum* f) const { return product(damped_, f); }  // J H^-1 f
  Eigen::Matrix3d flexibility() const { return gram(damped_); }                    // J H^-1 J^T
  Eigen::Matrix3d admittance() const { return gram(plain_); }                      // J M^-1 J^T

  // to += J^T load, load: (x, y, torque) on the rotor.
  void add_load(const Eigen::Vector3d& load, mjtNum* to) const { add(jacobian_, load, to); }
  // to += H M^-1 J^T load: a load over the step that no damper takes from.
  void add_impact(const Eigen::Vector3d& load, mjtNum* to) const;
  // to += M^-1 J^T load.
  void add_acceleration(const Eigen::Vector3d& load, mjtNum* to) const { add(plain_, load, to); }

 private:
  Eigen::Vector3d product(const mjtNum* rows, const mjtNum* v) const;
  Eigen::Matrix3d gram(const mjtNum* rows) const;
  void add(const mjtNum* rows, const Eigen::Vector3d& load, mjtNum* to) const;
  void solve_damped();

  const mjModel* m_;
  mjData* d_;
  int mark_, nv_;
  double damped_step_;                                       // s, h of H; 0: H is M
  mjtNum *jacobian_, *plain_ = nullptr, *damped_ = nullptr;  // 3 x nv
};

}  // namespace rotorub::plugin
