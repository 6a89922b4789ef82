// The two bending planes of a linear machine: the degrees of freedom that move the contacts in x
// and those that move them in y, and the undamped modes of each plane.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "plugin/twin/linear_machine.h"

namespace rotorub::plugin {

// One plane. The modes are scaled to 1 at the first contact (native_model/rotor/modal_rotor.h).
struct TwinPlane {
  std::vector<int> dofs;      // MuJoCo's degrees of freedom, n
  Eigen::MatrixXd shapes;     // n x modes: q = shapes eta
  Eigen::MatrixXd inverse;    // modes x n: eta = inverse q
  Eigen::VectorXd mass;       // kg, one for each mode
  Eigen::VectorXd stiffness;  // N/m
  // Mode values at each contact. At the first contact they are 1, or 0 for a mode that does not
  // move it.
  std::vector<Eigen::VectorXd> contacts;
};

struct TwinPlanes {
  TwinPlane x, y;
  std::vector<std::vector<int>> rings;  // for each contact: the two that move its ring, or none
  // Degrees of freedom that neither move rotor or rings nor are coupled to those that do.
  std::vector<int> ignored;
};

// Throws ConfigError, with the name of the joint, if the planes cannot be separated: a joint moves
// the rotor in both planes, a joint moves rotor and ring or two rings together, one joint alone or
// more than two move a ring, or the turning of the rotor or a ring is coupled to another joint.
TwinPlanes part_planes(const mjModel* m, const LinearMachine& machine);

}  // namespace rotorub::plugin
