// Further results of a contact in the last pass of this thread, for load_cells.h. They are kept
// apart from the contact's memory in mjData.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>

namespace rotorub::plugin {

struct NotedContact {
  const mjData* d = nullptr;
  double time = 0.0;
  int data = -1;
  Eigen::Vector2d e_r;
  double axial = 0.0;  // N, friction on the rotor along the ring's axis
};

// The results in the last pass of this thread, for the contact whose entries begin at `data`.
const NotedContact& noted_contact(int data);

// Records the results of the contact whose entries begin at `data`: the normal of its force in this
// pass, in the contact's axes, and the friction on the rotor along the ring's axis, N. The normal
// of an impact within the step differs from that of the state. Called for `rigid` with a force, and
// for contacts with friction along the axis.
void note_contact(const mjData* d, int data, const Eigen::Vector2d& e_r, double axial = 0.0);

}  // namespace rotorub::plugin
