// `rigid` over one step of MuJoCo for contacts that move together, two rings on one shaft: one
// problem (contact/coupled_law.h), not one after the other.
//
// A step has two parts. First contacts that last, (12)-(13), together over the step. Then the
// impacts, in no time, with the velocities that those leave: (15)-(19) for all closed contacts at a
// time, a lasting one takes part in a blow elsewhere on its shaft. A ring into which the others'
// impulses drive the rotor is closed too.
#pragma once

#include <mujoco/mujoco.h>

#include <span>

#include "native_model/contact/rigid_law.h"
#include "plugin/contact/contact_space.h"

namespace rotorub::plugin {

struct CoupledMember {
  const ContactSpace* space = nullptr;
  const ContactParameters* contact = nullptr;
  int data = 0;       // its memory (user_data.h)
  bool held = false;  // MuJoCo's constraints move with it
  RigidStep step;     // h, d, bend, start
  // Of a contact with friction that moves along its ring's axis (axial_motion.h), else null:
  // (velocity along the axis, tilt rates about x and y).
  const ContactSpace* axial = nullptr;
  Eigen::Vector3d axial_start{0.0, 0.0, 0.0};
};

// True where an impulse of one changes the rates of the other: for what is held, it may.
bool moves_with(const CoupledMember& a, const CoupledMember& b);

// As apply_rigid_step.
void apply_coupled_step(const mjModel* m, mjData* d, std::span<CoupledMember* const> members);

}  // namespace rotorub::plugin
