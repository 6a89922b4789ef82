// The contact of the segment rotor in contact space: (relative x, relative y, spin at the contact)
// = J qdot, J constant for small angles, with MuJoCo's own mass matrix.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"
#include "plugin/contact/contact_space.h"

namespace rotorub::plugin {

// Lives on the stack of mjData for as long as the object does. After mj_factorM of the step.
class SegmentSpace final : public ContactSpace {
 public:
  SegmentSpace(const Config& config, const mjModel* m, mjData* d);
  ~SegmentSpace() { d_->pstack = mark_; }

  void add_impact(const Eigen::Vector3d& load, mjtNum* to) const override;

 private:
  int ring_dof(int i) const;  // of coordinate i of the native layout
  double damping_factor(int dof) const;

  mjData* d_;
  const mjModel* m_;
  const Config& config_;
  int mark_;
};

}  // namespace rotorub::plugin
