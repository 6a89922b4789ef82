#include "native_model/rotor/segment_chain.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <numbers>
#include <string>

#include "native_model/rotor/powers.h"
#include "native_model/rotor/shaft_basis.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/scene.h"

namespace rotorub {
namespace {

// Both ends of the shaft and all stations, ascending and without duplicates.
std::vector<double> stations(const scene::Scene& scene) {
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  std::vector<double> all{0.0, geometry.length};
  for (const Station& station : stations_of(scene)) all.push_back(station.z);
  std::sort(all.begin(), all.end());
  constexpr double kSame = 1e-9;  // of the length
  const auto same = [&](double a, double b) { return b - a <= kSame * geometry.length; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  all.back() = geometry.length;
  return all;
}

// Divides the intervals between the stations, always the longest first, until there are `count`.
std::vector<double> nodes(const std::vector<double>& stations, int count) {
  const std::size_t intervals = stations.size() - 1;
  if (static_cast<std::size_t>(count) < intervals) {
    throw scene::SceneError(
        {{"", 0, "mujoco.segments",
          "are too few, because the scene's stations cut the shaft into " +
              std::to_string(intervals) + "; give " + std::to_string(intervals) + " to 200, not " +
              std::to_string(count)}});
  }
  std::vector<int> parts(intervals, 1);
  const auto length = [&](std::size_t i) { return (stations[i + 1] - stations[i]) / parts[i]; };
  for (std::size_t cut = intervals; cut < static_cast<std::size_t>(count); ++cut) {
    std::size_t longest = 0;
    for (std::size_t i = 1; i < intervals; ++i) {
      if (length(i) > length(longest) * (1.0 + 1e-9)) longest = i;
    }
    ++parts[longest];
  }
  std::vector<double> result;
  for (std::size_t i = 0; i < intervals; ++i) {
    for (int k = 0; k < parts[i]; ++k) result.push_back(stations[i] + k * length(i));
  }
  result.push_back(stations.back());
  return result;
}

// A cone is split into this many short cylinders. Their error falls with the square of their
// length, as the error of the segments does.
constexpr int kConePieces = 32;

// Calls add(length, middle, A, I) for each piece of constant section in the range.
template <typename Add>
void for_each_piece(const scene::RotorGeometry& geometry, double from, double to, const Add& add) {
  for (const scene::ShaftSection& section : geometry.sections) {
    const double a = std::max(from, section.from), b = std::min(to, section.to);
    if (b <= a) continue;
    const int pieces = section.tapered() ? kConePieces : 1;
    const double length = (b - a) / pieces;
    for (int i = 0; i < pieces; ++i) {
      const double z = pieces == 1 ? 0.5 * (a + b) : a + (i + 0.5) * length;
      const double outer = section.outer_at(z), inner = section.inner_at(z);
      add(length, z, std::numbers::pi / 4.0 * (outer * outer - inner * inner),
          std::numbers::pi / 64.0 * (fourth(outer) - fourth(inner)));
    }
  }
}

Segment rigid_segment(const scene::RotorGeometry& geometry, double node, double from, double to) {
  Segment s{node, from, to, 0.0, 0.0, 0.0, 0.0};
  for_each_piece(geometry, from, to, [&](double length, double z, double A, double) {
    s.mass += geometry.rho * A * length;
    s.centre += geometry.rho * A * length * z;
  });
  s.centre /= s.mass;
  for_each_piece(geometry, from, to, [&](double length, double z, double A, double I) {
    const double mass = geometry.rho * A * length, arm = z - s.centre;
    s.Jt += geometry.rho * I * length + mass * (length * length / 12.0 + arm * arm);
    s.Jp += geometry.rho * 2.0 * I * length;
  });
  return s;
}

}  // namespace

SegmentChain segment_chain(const scene::Scene& scene) {
  assert(scene.rotor.geometry);
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  if (geometry.theory == scene::ShaftTheory::kTimoshenko || geometry.axial_force != 0.0) {
    const bool sheared = geometry.theory == scene::ShaftTheory::kTimoshenko;
    throw scene::SceneError(
        {{"", 0, "mujoco.rotor",
          std::string("\"segments\" has no ") +
              (sheared ? "shear deformation (rotor.theory)" : "axial force (rotor.axial_force)") +
              "; set \"modal\""}});
  }
  const std::vector<double> z = nodes(stations(scene), scene.mujoco.segments);
  SegmentChain chain;
  double from = 0.0;
  for (std::size_t k = 0; k < z.size(); ++k) {
    const bool last = k + 1 == z.size();
    const double to = last ? geometry.length : 0.5 * (z[k] + z[k + 1]);
    chain.segments.push_back(rigid_segment(geometry, z[k], from, to));
    from = to;
    if (last) break;
    double flexibility = 0.0;  // 1/m^3, int dz / I
    for_each_piece(geometry, z[k], z[k + 1],
                   [&](double length, double, double, double I) { flexibility += length / I; });
    chain.joint.push_back(to);
    chain.bending_stiffness.push_back(geometry.E / flexibility);
    chain.torsion_stiffness.push_back(2.0 * geometry.G / flexibility);
  }
  return chain;
}

Eigen::RowVectorXd SegmentChain::deflection(double z) const {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(plane_size());
  row[0] = 1.0;
  row[1] = z - segments.front().node;
  for (std::size_t k = 0; k < joint.size() && joint[k] < z; ++k) {
    row[static_cast<Eigen::Index>(k) + 2] = z - joint[k];
  }
  return row;
}

Eigen::RowVectorXd SegmentChain::slope(double z) const {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(plane_size());
  row[1] = 1.0;
  for (std::size_t k = 0; k < joint.size() && joint[k] < z; ++k) {
    row[static_cast<Eigen::Index>(k) + 2] = 1.0;
  }
  return row;
}

int SegmentChain::node_at(double z) const {
  return static_cast<int>(std::lower_bound(joint.begin(), joint.end(), z) - joint.begin());
}

bool has_elastic_torsion(const scene::Scene& scene) {
  return scene.rotor.torsion.has_value() || scene.drive.has_value();
}

}  // namespace rotorub
