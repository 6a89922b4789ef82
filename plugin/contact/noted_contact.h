// What the forces of a contact leave for load_cells.h in the pass of this thread, beside its
// memory.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>

namespace rotorub::plugin {

struct NotedContact {
  const mjData* d = nullptr;
  double time = 0.0;
  int data = -1;
  Eigen::Vector2d e_r;
  double axial = 0.0;  // N
};

// Of the pass that this thread did last.
const NotedContact& noted_contact(int data);

// Of the contact whose memory is at `data`, in its axes: the normal of its force in this pass,
// which of a blow is not that of the state, and the friction on the rotor along the ring's axis, N.
// Of `rigid`, and where that is.
void note_contact(const mjData* d, int data, const Eigen::Vector2d& e_r, double axial = 0.0);

}  // namespace rotorub::plugin
