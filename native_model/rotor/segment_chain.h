// The shaft as a chain of rigid segments (Hencky's bar chain), used by the segment rotor in MuJoCo.
// It shares no shape function with the Ritz ansatz and converges to the same beam.
//
// Nodes z_0 = 0, ..., z_N = length lie at every station of the scene and between them. Each node
// has a rigid segment, which reaches from the middle of one interval to the middle of the next and
// has the mass and inertia of that piece of shaft. In the middle of interval k two segments meet in
// a joint with the stiffness of the beam over the whole interval,
//   k_b = 1 / int dz/(E I),   k_t = 1 / int dz/(2 G I)      (z_{k-1} to z_k)
// The angle of a segment is then the slope of the beam at its node, u_k - u_{k-1} is the
// trapezoidal rule of the slope, and the frequencies converge with the square of the interval.
// Discs, bearings and loads act at nodes.
//
// Coordinates of one plane (N + 2): deflection at z_0, slope of the first segment, then the angles
// of the N joints. Coordinates of torsion (N + 1): the angle of each segment about z.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "native_model/scene/forward.h"

namespace rotorub {

// Rigid piece of shaft around one node, without discs.
struct Segment {
  double node;      // m, station
  double from, to;  // m, stations of its ends
  double mass;      // kg
  double centre;    // m, station of the centre of mass
  double Jt, Jp;    // kg m^2, about the centre of mass: transverse and polar
};

struct SegmentChain {
  std::vector<Segment> segments;          // N + 1
  std::vector<double> joint;              // m, N, stations of the joints
  std::vector<double> bending_stiffness;  // N m/rad, N
  std::vector<double> torsion_stiffness;  // N m/rad, N

  Eigen::Index plane_size() const { return static_cast<Eigen::Index>(segments.size()) + 1; }
  Eigen::RowVectorXd deflection(double z) const;  // row over the coordinates of a plane
  Eigen::RowVectorXd slope(double z) const;       // 1/m; at a node: slope of its segment
  int node_at(double z) const;                    // index of the segment that contains z
};

// Divides the shaft into scene.mujoco.segments intervals; the longest interval is divided first.
// The rotor must be in geometry form. Throws scene::SceneError if there are more intervals between
// stations than segments.
SegmentChain segment_chain(const scene::Scene& scene);

// Matrices and modes of the chain at rest (small angles), with discs, bearings and damping ratios.
// They leave out the bearings' dashpots and the magnetic bearings, except that the bending
// stiffnesses include the springs that hold the modes (MagneticSupport::modal_spring).
struct SegmentMatrices {
  Eigen::MatrixXd mass, gyroscopic;          // (N + 2) x (N + 2)
  Eigen::MatrixXd stiffness_x, stiffness_y;  // (N + 2) x (N + 2)
  Eigen::MatrixXd damping_x, damping_y;      // external: each mode damped by its ratio
  Eigen::MatrixXd internal;                  // rotating damping on the modes of the mean stiffness
  Eigen::VectorXd spin_inertia;              // kg m^2, N + 1, with discs and motor
  Eigen::MatrixXd torsion_damping;           // N m s/rad, (N + 1) x (N + 1)
  // The kept modes with the scaling of the native model; one column over the chain's coordinates
  // per mode.
  Eigen::MatrixXd shape_x, shape_y, shape_torsion;
  double highest = 0.0;  // rad/s, highest frequency of the chain in bending and torsion
};

// modes, torsion_modes: the numbers of modes to keep. Without a drive the shaft is held at its
// first node for torsion. Throws scene::SceneError if the chain has fewer modes.
SegmentMatrices segment_matrices(const scene::Scene& scene, const SegmentChain& chain, int modes,
                                 int torsion_modes);

// True if the scene keeps torsion modes or has a drive; the torsion of the segment rotor is then
// elastic.
bool has_elastic_torsion(const scene::Scene& scene);

}  // namespace rotorub
