#include <algorithm>
#include <string>

#include "native_model/rotor/modal_reduction.h"
#include "native_model/rotor/rotor_modes.h"
#include "native_model/rotor/segment_chain.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/scene.h"

namespace rotorub {
namespace {

void fill_inertia(const scene::RotorGeometry& geometry, const SegmentChain& chain,
                  SegmentMatrices& m) {
  const auto add = [&](double node, double z, double mass, double Jt, double Jp) {
    // The segment is the one of the node, even if the centre of mass lies beyond the joint.
    const Eigen::RowVectorXd tilt = chain.slope(node);
    const Eigen::RowVectorXd u = chain.deflection(node) + (z - node) * tilt;
    m.mass += mass * u.transpose() * u + Jt * tilt.transpose() * tilt;
    m.gyroscopic += Jp * tilt.transpose() * tilt;
  };
  for (const Segment& s : chain.segments) add(s.node, s.centre, s.mass, s.Jt, s.Jp);
  for (const scene::Disc& disc : geometry.discs) add(disc.z, disc.z, disc.mass, disc.Jt, disc.Jp);
}

Eigen::MatrixXd stiffness(const scene::RotorGeometry& geometry, const SegmentChain& chain,
                          int plane) {
  const Eigen::Index n = chain.plane_size();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 2; k < n; ++k) {
    K(k, k) = chain.bending_stiffness[static_cast<std::size_t>(k) - 2];
  }
  for (const scene::ShaftBearing& bearing : geometry.bearings) {
    const Eigen::RowVectorXd u = chain.deflection(bearing.z);
    K += bearing.stiffness[plane] * u.transpose() * u;
  }
  return K;
}

std::vector<double> node_stations(const SegmentChain& chain) {
  std::vector<double> z;
  for (const Segment& s : chain.segments) z.push_back(s.node);
  return z;
}

// The first `kept` modes with the scaling of the native model.
Eigen::MatrixXd scaled_shapes(const scene::Scene& scene, const SegmentChain& chain,
                              const PlanarModes& modes, int kept) {
  Eigen::MatrixXd shape = modes.shape.leftCols(kept);
  for (int j = 0; j < kept; ++j) {
    const auto value = [&](double z) { return chain.deflection(z).dot(modes.shape.col(j)); };
    shape.col(j) *= mode_scale(value, node_stations(chain), contact_station(scene)).factor;
  }
  return shape;
}

// modes: include the springs of magnetic bearings, if there are any. Damping ratios refer to the
// modes without these springs.
void fill_damping(const scene::Scene& scene, const SegmentChain& chain, OwnModes modes,
                  SegmentMatrices& m) {
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  if (has_modal_springs(scene)) {
    const Eigen::MatrixXd x = stiffness(geometry, chain, 0), y = stiffness(geometry, chain, 1);
    const auto own = [&](const Eigen::MatrixXd& of, const PlanarModes& with) {
      return free_modes(m.mass, of, with.frequency[0]);
    };
    modes = {own(x, modes.x), own(y, modes.y), own(0.5 * (x + y), modes.mean)};
  }
  m.damping_x = modal_damping(m.mass, modes.x, geometry.damping_ratio);
  m.damping_y = modal_damping(m.mass, modes.y, geometry.damping_ratio);
  m.internal = modal_damping(m.mass, modes.mean, geometry.internal_damping_ratio);
}

void fill_bending(const scene::Scene& scene, const SegmentChain& chain, int kept,
                  SegmentMatrices& m) {
  const scene::RotorGeometry geometry = supported(scene);
  m.stiffness_x = stiffness(geometry, chain, 0);
  m.stiffness_y = stiffness(geometry, chain, 1);
  const PlanarModes x = planar_modes(m.mass, m.stiffness_x);
  const PlanarModes y = planar_modes(m.mass, m.stiffness_y);
  const PlanarModes mean = planar_modes(m.mass, 0.5 * (m.stiffness_x + m.stiffness_y));
  fill_damping(scene, chain, {x, y, mean}, m);
  m.shape_x = scaled_shapes(scene, chain, x, kept);
  m.shape_y = scaled_shapes(scene, chain, y, kept);
  m.highest = std::max(x.frequency.maxCoeff(), y.frequency.maxCoeff());
}

// Angles of the segments from the twists of the N joints. With a drive the share of the rigid spin
// is removed; without one the first segment is held.
Eigen::MatrixXd twist_basis(const Eigen::VectorXd& inertia, bool driven) {
  const Eigen::Index n = inertia.size();
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(n, n - 1);
  for (Eigen::Index i = 0; i < n; ++i) basis.row(i).head(i).setOnes();
  if (driven) {
    const Eigen::RowVectorXd offset = inertia.transpose() * basis / inertia.sum();
    basis.rowwise() -= offset;
  }
  return basis;
}

void fill_torsion(const scene::Scene& scene, const SegmentChain& chain, int kept,
                  SegmentMatrices& m) {
  const auto n = static_cast<Eigen::Index>(chain.segments.size());
  m.spin_inertia.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    m.spin_inertia[i] = chain.segments[static_cast<std::size_t>(i)].Jp;
  }
  for (const scene::Disc& disc : scene.rotor.geometry->discs) {
    m.spin_inertia[chain.node_at(disc.z)] += disc.Jp;
  }
  if (scene.drive) m.spin_inertia[chain.node_at(scene.drive->station)] += scene.drive->inertia;
  m.shape_torsion = Eigen::MatrixXd::Zero(n, kept);
  m.torsion_damping = Eigen::MatrixXd::Zero(n, n);
  if (!has_elastic_torsion(scene)) return;

  const Eigen::MatrixXd basis = twist_basis(m.spin_inertia, scene.drive.has_value());
  const Eigen::VectorXd stiffness =
      Eigen::Map<const Eigen::VectorXd>(chain.torsion_stiffness.data(), n - 1);
  const Eigen::MatrixXd inertia = basis.transpose() * m.spin_inertia.asDiagonal() * basis;
  const PlanarModes modes = planar_modes(inertia, stiffness.asDiagonal());
  const Eigen::MatrixXd angle = basis * modes.shape;  // scaled to unit inertia
  const double ratio = scene.rotor.torsion ? scene.rotor.torsion->damping_ratio
                                           : scene.rotor.geometry->damping_ratio;
  const Eigen::MatrixXd momentum = m.spin_inertia.asDiagonal() * angle;
  m.torsion_damping =
      momentum * (2.0 * ratio * modes.frequency).asDiagonal() * momentum.transpose();
  for (int j = 0; j < kept; ++j) {
    const auto value = [&](double z) { return angle(chain.node_at(z), j); };
    const ModeScale scale = mode_scale(value, node_stations(chain), contact_station(scene));
    m.shape_torsion.col(j) = scale.factor * angle.col(j);
  }
  m.highest = std::max(m.highest, modes.frequency.maxCoeff());
}

// A chain has as many modes as coordinates: N + 2 in bending, N in elastic torsion.
void check_modes(const SegmentChain& chain, int modes, int torsion_modes) {
  const auto segments = static_cast<int>(chain.joint.size());
  const int needed = std::max(modes - 2, torsion_modes);
  if (needed <= segments) return;
  throw scene::SceneError(
      {{"", 0, "mujoco.segments",
        "are too few for the modes that the scene keeps; give " + std::to_string(needed) +
            " to 200, not " + std::to_string(segments)}});
}

}  // namespace

SegmentMatrices segment_matrices(const scene::Scene& scene, const SegmentChain& chain, int modes,
                                 int torsion_modes) {
  check_modes(chain, modes, torsion_modes);
  const Eigen::Index n = chain.plane_size();
  SegmentMatrices m;
  m.mass = m.gyroscopic = Eigen::MatrixXd::Zero(n, n);
  fill_inertia(*scene.rotor.geometry, chain, m);
  fill_bending(scene, chain, modes, m);
  fill_torsion(scene, chain, torsion_modes, m);
  return m;
}

}  // namespace rotorub
