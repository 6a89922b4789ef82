// The contact of a user's own model in contact space: (relative x, relative y, spin) = J qvel in
// the frame of the ring's geom, z its axis, with MuJoCo's own Jacobians and mass matrix. The rotor
// is seen from the ring, which may move, tilt and turn.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>

#include "plugin/config.h"
#include "plugin/contact/contact_space.h"
#include "plugin/mujoco_versions.h"
#include "plugin/own/tree_factor.h"

namespace rotorub::plugin {

// The frame of the contact, columns x, y, z, row by row: that of the ring's geom; of a generated model
// the world's.
const mjtNum* contact_axes(const Config& config, const mjData* d);
// Speed of a generated model's rotor that is held, and no degree of freedom, rad/s.
double held_spin(const Config& config);
// Where the rotor's centre is in the ring, m.
Eigen::Vector2d own_position(const Config& config, const mjData* d);

// Whether rotor and ring overlap along the ring's axis.
bool face_each_other(const Config& config, const mjData* d);

// Lives on the stack of mjData for as long as the object does.
class OwnSpace final : public ContactSpace {
 public:
  OwnSpace(const Config& config, const mjModel* m, mjData* d);

  // Solves with M and H; needed once, before all but `rates` and `add_load`. H = M + h D is the
  // matrix of the Euler step, near that of `implicit`; M alone for RK4.
  void solve();

  void add_impact(const Eigen::Vector3d& load, mjtNum* to) const override;

 private:
  void add_body(const mjtNum* axes, const mjtNum* centre, int body, double sign);
  void solve_rows(const mjtNum* factor, const mjtNum* inverse, mjtNum* rows) const;

  const mjModel* m_;
  mjData* d_;
  StackFrame room_;
  double damped_step_;  // s, h of H; 0: H is M
  DofRange trees_[2];   // of rotor and ring; the second empty where they share one
};

}  // namespace rotorub::plugin
