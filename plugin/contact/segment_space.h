// The contact of the segment rotor in contact space: (relative x, relative y, spin at the contact)
// = J qdot, J constant for small angles, with MuJoCo's own mass matrix.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"
#include "plugin/contact/contact_space.h"
#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {

// Lives on the stack of mjData for as long as the object does. After mj_factorM of the step.
class SegmentSpace final : public ContactSpace {
 public:
  SegmentSpace(const Config& config, const mjModel* m, mjData* d);

  void add_impact(const Eigen::Vector3d& load, mjtNum* to) const override;

 private:
  int ring_dof(int i) const;  // of coordinate i of the native layout
  double damping_factor(int dof) const;

  const mjModel* m_;
  const Config& config_;
  StackFrame room_;
};

}  // namespace rotorub::plugin
