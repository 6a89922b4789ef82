// The segment rotor in an mjModel: where its joints are, its state in the native model's
// coordinates, and the loads that its joints do not have by themselves.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/rotor/segment_chain.h"
#include "native_model/scene/forward.h"

namespace rotorub::plugin {

struct Config;

// A joint with one coordinate: qpos[position], qvel[velocity].
struct JointAddress {
  int position = -1, velocity = -1;
};

struct Segments {
  SegmentChain chain;
  std::vector<JointAddress> x, y;  // N + 2 each, in the chain's order
  std::vector<JointAddress> spin;  // N + 1

  // Loads, in the chain's coordinates.
  Eigen::MatrixXd damping_x, damping_y;  // external damping; empty: none
  Eigen::MatrixXd torsion_damping;       // empty: none
  // The loads that the native list of loads (model/loads.h) computes and the joints do not:
  // rotating damping, forces, lost blades, magnetic bearings. Its modes are the coordinates of a
  // plane, its spin is the mean spin; then come the coordinates of the magnetic bearings'
  // integrators.
  Model bending;
  int drive_node = -1;         // node of the motor; -1: the speed is prescribed
  Eigen::VectorXd spin_share;  // N + 1, J_k / sum J, the weights of the mean spin

  // Native modal coordinates from a state of the chain: the share of each kept mode, changed so
  // that the deflection and the twist at the contacts are kept exactly (completed() in
  // segments.cc). modes x coordinates; with a free spin, `spin_row` gives its angle.
  Eigen::MatrixXd modes_x, modes_y, modes_torsion;
  Eigen::RowVectorXd spin_row;

  double highest = 0.0;  // rad/s, highest frequency at rest
};

// Makes the chain of the scene; find(name) returns the address of a joint. Throws
// scene::SceneError.
Segments make_segments(const scene::Scene& scene, const Model& model,
                       const std::function<JointAddress(const std::string&)>& find);

// Fill the rotor's part of the native coordinates q (rates v) from qpos (qvel).
void native_position(const Segments& segments, const Model& model, const mjtNum* qpos, double* q);
void native_velocity(const Segments& segments, const Model& model, const mjtNum* qvel, double* v);

// The reason why the step (s) is too long for MuJoCo, which treats the chain's springs explicitly;
// empty if it is not too long.
std::string segment_step_refusal(const Segments& segments, double step);

// Adds to d->qfrc_passive the loads that the joints and tendons of the segment rotor do not have by
// themselves: external and rotating damping of its modes, forces, magnetic bearings, drive, weight
// of the ring. MuJoCo itself has springs, bearings, gyroscopics, unbalance and the rotor's weight.
// The config must have a segment rotor.
void add_segment_loads(const Config& config, const mjModel* m, mjData* d);

}  // namespace rotorub::plugin
