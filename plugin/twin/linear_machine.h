// A user's own machine for small motions about the pose of qpos0, as MuJoCo models it: its mass
// matrix, and central differences of its smooth forces.
//
//   M q'' + (D + Omega G) q' + K q = f,      q: nv values, tangent coordinates from qpos0
//
// Omega is the rotor's speed. The matrices are means over a turn of the rotor (four angles); the
// part that turns with the rotor is its unbalance, which is kept apart. Unbalance couples spin and
// bending in the mass matrix. If a mass element dm is at r from the axis and bending moves the axis
// beside it by J, the spin's column of M contains
//
//   b(phi) = sum J^T (e_z x r(phi)) dm,
//
// and its centrifugal force is Omega^2 sum J^T r(phi) dm.
// Because r(phi) = -e_z x r(phi + 90 degrees), b at two angles describes all unbalance: static,
// dynamic (products of inertia), and the unbalance of parts that bend. Columns and rows are
// MuJoCo's degrees of freedom; units are m and rad, N and N m, kg and kg m^2.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <vector>

#include "plugin/model/config.h"
#include "plugin/twin/probe.h"

namespace rotorub::plugin {

// One rotor in its ring. The axes are x and y of the first ring's geom.
struct LinearContact {
  AxisJoint ring_turn;              // the joint that turns the ring about its z axis
  Eigen::MatrixXd rotor, ring;      // 2 x nv, Jacobians of their centres
  Eigen::Vector2d apart{0.0, 0.0};  // m, from the ring's to the rotor's centre at qpos0
  // N m, deviation of the ring's drag from a linear one, at the greater of the ring's and the
  // rotor's speeds.
  double bent_drag = 0.0;
};

struct LinearMachine {
  AxisJoint spin;  // the joint that turns the rotor about the contacts' z axis
  // nv x nv. D is symmetric except for actuators; G is antisymmetric if it is purely gyroscopic.
  Eigen::MatrixXd mass, stiffness, damping, gyroscopic;
  Eigen::VectorXd force;  // nv, at rest at qpos0, including gravity and actuators
  std::vector<LinearContact> contacts;
  Eigen::VectorXd unbalance[2];   // nv, kg m or kg m^2: b at phi = 0 and at a quarter turn
  double unbalance_torque = 0.0;  // N m, largest torque of its weight about the axis
  // Torque of the drive at speeds from 0 to twice `speed`, N m; empty without a spin.
  double speed = 0.0;  // rad/s, the speed for which G and the torques are found
  std::vector<double> torque;

  // Relative sizes of the effects that the means leave out.
  // Change of the mass matrix of a rotor that is not a body of revolution.
  double uneven_inertia = 0.0;
  // Changes at a deflection of one clearance: of the mass matrix, of the springs' forces, and of
  // the contact's place.
  double bent_mass = 0.0, bent_stiffness = 0.0, bent_contact = 0.0;
};

// m: the model of a config with `own`. `start`: the state that supplies the controls and the
// rotor's speed. Only the callbacks of actuators are called. Throws ConfigError, with the name of
// the part, if something cannot be linearised (probe.h).
LinearMachine linear_machine(const mjModel* m, const Config& config, const mjData* start);

}  // namespace rotorub::plugin
