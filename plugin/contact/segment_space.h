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
  SegmentSpace(const Config& config, const mjModel* m, mjData* d, const StepMatrix& matrix);

 private:
  StackFrame room_;
};

}  // namespace rotorub::plugin
