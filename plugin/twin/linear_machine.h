// A user's own machine for small motions about the pose of qpos0, as MuJoCo sees it: its mass
// matrix, and central differences of its smooth forces.
//
//   M q'' + (D + Omega G) q' + K q = f,      q: nv values, tangent coordinates from qpos0
//
// Omega: the rotor's speed. Means over a turn of the rotor (of four angles): what turns with it is
// its unbalance, kept apart. Unbalance is what couples spin and bending in the mass matrix. Where a
// mass element dm stands at r from the axis and bending moves the axis beside it by J, the spin's
// column of M has
//
//   b(phi) = sum J^T (e_z x r(phi)) dm,      its centrifugal force is Omega^2 sum J^T r(phi) dm
//
// and r(phi) = -e_z x r(phi + 90 degrees): b at two angles is all of it, static, dynamic (products
// of inertia) and of parts that bend. Columns and rows are those of MuJoCo's degrees of freedom;
// units are m and rad, N and N m, kg and kg m^2.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <vector>

#include "plugin/model/config.h"
#include "plugin/twin/probe.h"

namespace rotorub::plugin {

// One rotor in its ring; axes are x and y of the first ring's geom.
struct LinearContact {
  AxisJoint ring_turn;              // what turns the ring about its z
  Eigen::MatrixXd rotor, ring;      // 2 x nv, of their centres
  Eigen::Vector2d apart{0.0, 0.0};  // m, the rotor's centre from the ring's in the pose of qpos0
  // N m, what the drag on the ring leaves of a linear one, at its speed or the rotor's.
  double bent_drag = 0.0;
};

struct LinearMachine {
  AxisJoint spin;  // what turns the rotor about the contacts' z
  // nv x nv; D symmetric but for what actuators do, G antisymmetric where it is gyroscopic.
  Eigen::MatrixXd mass, stiffness, damping, gyroscopic;
  Eigen::VectorXd force;  // nv, at rest in the pose of qpos0, gravity and actuators included
  std::vector<LinearContact> contacts;
  Eigen::VectorXd unbalance[2];   // nv, kg m or kg m^2: b where phi is 0 and a quarter turn
  double unbalance_torque = 0.0;  // N m, largest that weight has about the axis by it
  // Torque of the drive at speeds from 0 to twice `speed`, N m; empty without a spin.
  double speed = 0.0;  // rad/s, that G and the torques are of
  std::vector<double> torque;

  // Shares of what the means leave out.
  double uneven_inertia = 0.0;  // of the mass matrix: a rotor that is no body of revolution
  // At one clearance of deflection: of the mass matrix, of the springs, of the contact's place.
  double bent_mass = 0.0, bent_stiffness = 0.0, bent_contact = 0.0;
};

// m: the model of an own config. `start`: where controls and the rotor's speed are taken from.
// Callbacks for actuators are called, and no others. Throws ConfigError naming what cannot be
// linearised (probe.h).
LinearMachine linear_machine(const mjModel* m, const Config& config, const mjData* start);

}  // namespace rotorub::plugin
