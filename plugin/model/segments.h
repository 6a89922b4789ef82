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

// A joint of one coordinate: qpos[position], qvel[velocity].
struct JointAddress {
  int position = -1, velocity = -1;
};

struct Segments {
  SegmentChain chain;
  std::vector<JointAddress> x, y;  // N + 2 each, in the chain's order
  std::vector<JointAddress> spin;  // N + 1

  // Loads, in the chain's coordinates.
  Eigen::MatrixXd damping_x, damping_y;  // external; empty: none
  Eigen::MatrixXd torsion_damping;       // empty: none
  // What the native list of loads (model/loads.h) has in the place of the joints' own: rotating
  // damping, forces, blades that are lost, magnetic bearings. Its modes are the coordinates of a
  // plane, its spin the mean one; then come those of magnetic bearings' integrators.
  Model bending;
  int drive_node = -1;         // -1: speed held
  Eigen::VectorXd spin_share;  // N + 1, J_k / sum J: mean spin

  // Native modal coordinates of a state of the chain: the share of each mode kept, and the whole
  // deflection at the contacts, of which the first modes take what is not in the others.
  Eigen::MatrixXd project_x, project_y, project_torsion;  // kept x coordinates
  std::vector<Eigen::RowVectorXd> contact_rows;           // of each contact; empty: none
  std::vector<int> contact_nodes;

  double highest = 0.0;  // rad/s, highest frequency at rest
};

// The chain of the scene; find(name) gives the address of a joint. Throws scene::SceneError.
Segments make_segments(const scene::Scene& scene, const Model& model,
                       const std::function<JointAddress(const std::string&)>& find);

// Fills the rotor's part of native coordinates (or of their rates) from qpos (qvel).
void native_position(const Segments& segments, const Model& model, const mjtNum* qpos, double* q);
void native_velocity(const Segments& segments, const Model& model, const mjtNum* qvel, double* v);

// Empty, or why MuJoCo's step cannot carry the chain: it is explicit in the springs.
std::string segment_step_refusal(const Segments& segments, double step);

// What the joints and tendons of the segment rotor do not have by themselves, as passive forces:
// external and rotating damping of its modes, forces, magnetic bearings, drive, weight of the ring.
// Springs, bearings, gyroscopics, unbalance and the rotor's weight are MuJoCo's own. Adds to
// d->qfrc_passive. The config is that of a segment rotor.
void add_segment_loads(const Config& config, const mjModel* m, mjData* d);

}  // namespace rotorub::plugin
