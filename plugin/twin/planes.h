// The two bending planes of a linear machine: which degrees of freedom move with the contacts' x,
// which with their y, and the undamped modes of each.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "plugin/twin/linear_machine.h"

namespace rotorub::plugin {

// One plane. Modes are scaled to 1 at the first contact (native_model/rotor/modal_rotor.h).
struct TwinPlane {
  std::vector<int> dofs;      // of MuJoCo, n
  Eigen::MatrixXd shapes;     // n x modes: q = shapes eta
  Eigen::MatrixXd inverse;    // modes x n: eta = inverse q
  Eigen::VectorXd mass;       // kg, modes
  Eigen::VectorXd stiffness;  // N/m
  // Mode values at each contact; at the first 1, or 0 for a mode that does not move it.
  std::vector<Eigen::VectorXd> contacts;
};

struct TwinPlanes {
  TwinPlane x, y;
  std::vector<std::vector<int>> rings;  // of each contact the two that move its ring, or none
  std::vector<int> ignored;  // those that move neither rotor nor rings, nor what moves them
};

// Throws ConfigError naming the joint where the planes do not part: a joint that moves the rotor in
// both, rotor and ring or two rings together, or a ring beside its two slides; a turning that acts
// on another joint.
TwinPlanes part_planes(const mjModel* m, const LinearMachine& machine);

}  // namespace rotorub::plugin
