// `rigid` over one step of MuJoCo for contacts that move together, two rings on one shaft: one
// problem (native_model/contact/coupled_law.h), not one after the other.
//
// A step has two parts. First contacts that last, (12)-(13), together over the step. Then the
// impacts, in no time, with the velocities that those leave: (15)-(19) for all closed contacts at a
// time, a lasting one takes part in a blow elsewhere on its shaft. Beside constraints the forces of
// the step may then close a gap again (constrained_law.h). A ring into which the others' impulses
// drive the rotor is closed too.
#pragma once

#include <mujoco/mujoco.h>

#include <span>

#include "native_model/contact/rigid_law.h"
#include "plugin/contact/contact_space.h"

namespace rotorub::plugin {

// A contact of the pass.
struct CoupledMember {
  const ContactPair* pair = nullptr;
  const ContactSpace* space = nullptr;
  bool held = false;  // MuJoCo's constraints move with it
  RigidStep step;     // h, d, bend, start, was_in_contact
  // Of a contact with friction that moves along its ring's axis (relative_motion.h), else null:
  // (velocity along the axis, tilt rates about x and y).
  const ContactSpace* axial = nullptr;
  Eigen::Vector3d axial_start{0.0, 0.0, 0.0};

  // What the step comes to.
  RigidResult result;
  double axial_friction = 0.0;  // N s, on the rotor along the axis
};

// Fills the results, and adds the impulses as forces over the step. After update_smooth_force.
void apply_coupled_step(const mjModel* m, mjData* d, std::span<CoupledMember* const> members,
                        mjtNum* to);

}  // namespace rotorub::plugin
