// The shaft as a chain of rigid segments (Hencky's bar chain): what MuJoCo's second rotor is made
// of. It shares no shape function with the Ritz ansatz, and converges to the same beam.
//
// Nodes z_0 = 0, ..., z_N = length stand at every station of the scene and between. About each lies
// a rigid segment, from the middle of one interval to the middle of the next, with the mass and the
// inertia of that piece of shaft. In the middle of interval k two segments meet in a joint with the
// beam's stiffness over the whole interval,
//   k_b = 1 / int dz/(E I),   k_t = 1 / int dz/(2 G I)      (z_{k-1} to z_k)
// so that the angle of a segment is the beam's slope at its node, u_k - u_{k-1} is the trapezoidal
// rule of the slope, and frequencies converge with the square of the interval. Discs, bearings and
// loads act at nodes.
//
// Coordinates of one plane (N + 2): deflection at z_0, slope of the first segment, then the angles
// of the N joints. Those of torsion (N + 1): the angle of each segment about z.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "native_model/scene/forward.h"

namespace rotorub {

// Rigid piece of shaft about one node, without discs.
struct Segment {
  double node;      // m, station
  double from, to;  // m
  double mass;      // kg
  double centre;    // m, station of the centre of mass
  double Jt, Jp;    // kg m^2, about the centre of mass: across and along the shaft
};

struct SegmentChain {
  std::vector<Segment> segments;          // N + 1
  std::vector<double> joint;              // m, N, stations of the joints
  std::vector<double> bending_stiffness;  // N m/rad, N
  std::vector<double> torsion_stiffness;  // N m/rad, N

  Eigen::Index plane_size() const { return static_cast<Eigen::Index>(segments.size()) + 1; }
  Eigen::RowVectorXd deflection(double z) const;  // row over the coordinates of a plane
  Eigen::RowVectorXd slope(double z) const;       // 1/m; z at a node: of its segment
  int node_at(double z) const;                    // index of the segment that holds station z
};

// Cut into scene.mujoco.segments intervals, the longest first. The rotor must be in geometry form.
// Throws scene::SceneError where there are more stations than segments can end at.
SegmentChain segment_chain(const scene::Scene& scene);

// Matrices of the chain at rest (small angles), with discs, bearings and damping ratios, and its
// modes. The magnetic bearing and the bearings' dashpots are not in them.
struct SegmentMatrices {
  Eigen::MatrixXd mass, gyroscopic;          // N + 2 square
  Eigen::MatrixXd stiffness_x, stiffness_y;  // N + 2 square
  Eigen::MatrixXd damping_x, damping_y;      // external: every mode damped by its ratio
  Eigen::MatrixXd internal;                  // rotating damping, of the modes of the mean stiffness
  Eigen::VectorXd spin_inertia;              // kg m^2, N + 1, with discs and motor
  Eigen::MatrixXd torsion_damping;           // N m s/rad, N + 1 square
  // The kept modes as the native model scales them: columns over the chain's coordinates.
  Eigen::MatrixXd shape_x, shape_y, shape_torsion;
  double highest = 0.0;  // rad/s, of bending and torsion
};

// modes, torsion_modes: how many are kept. The torsion of a rotor whose speed is held is that of a
// shaft held at its first node. Throws scene::SceneError where the chain has fewer modes.
SegmentMatrices segment_matrices(const scene::Scene& scene, const SegmentChain& chain, int modes,
                                 int torsion_modes);

// The segment rotor's torsion is elastic where the scene keeps torsion modes or has a drive.
bool has_elastic_torsion(const scene::Scene& scene);

}  // namespace rotorub
