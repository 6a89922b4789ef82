// The two bending planes of a linear machine: which degrees of freedom move with the contact's x,
// which with its y, and the undamped modes of each.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "plugin/twin/linear_machine.h"

namespace rotorub::plugin {

// One plane. Modes are scaled to 1 at the contact (native_model/rotor/modal_rotor.h).
struct TwinPlane {
  std::vector<int> dofs;      // of MuJoCo, n
  Eigen::MatrixXd shapes;     // n x modes: q = shapes eta
  Eigen::MatrixXd inverse;    // modes x n: eta = inverse q
  Eigen::VectorXd mass;       // kg, modes
  Eigen::VectorXd stiffness;  // N/m
  Eigen::VectorXd contact;    // 1, or 0 for a mode that does not move the contact
};

struct TwinPlanes {
  TwinPlane x, y;
  std::vector<int> ring;     // the two degrees of freedom of the ring, or none
  std::vector<int> ignored;  // those that move neither rotor nor ring, nor what moves them
};

// Throws ConfigError naming the joint where the planes do not part: a joint that moves the rotor in
// both, rotor and ring together, or the ring beside its two slides; a turning that acts on another
// joint.
TwinPlanes part_planes(const mjModel* m, const LinearMachine& machine);

}  // namespace rotorub::plugin
