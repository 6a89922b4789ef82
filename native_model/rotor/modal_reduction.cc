#include "native_model/rotor/modal_reduction.h"

#include "native_model/rotor/mode_scaling.h"

namespace rotorub {
namespace {

// Modes of one plane, scaled: columns of Ritz coordinates.
struct ScaledModes {
  Eigen::MatrixXd shape;    // N x kept
  Eigen::VectorXd contact;  // kept, exactly 1 or 0
};

ScaledModes scaled(const BendingBasis& basis, const PlanarModes& modes, int kept,
                   std::optional<double> contact) {
  const std::vector<double> stations = line_stations(basis.mesh());
  ScaledModes result{modes.shape.leftCols(kept), Eigen::VectorXd(kept)};
  for (int j = 0; j < kept; ++j) {
    const Eigen::VectorXd column = result.shape.col(j);
    const ModeScale scale =
        mode_scale([&](double z) { return basis.deflection(z).dot(column); }, stations, contact);
    result.shape.col(j) *= scale.factor;
    result.contact[j] = scale.contact;
  }
  return result;
}

PlaneModes plane(const Eigen::MatrixXd& mass, const PlanarModes& modes, const ScaledModes& phi,
                 double damping_ratio) {
  const Eigen::Index kept = phi.contact.size();
  PlaneModes result{Eigen::VectorXd(kept), {}, {}};
  for (Eigen::Index j = 0; j < kept; ++j) {
    result.mass[j] = phi.shape.col(j).dot(mass * phi.shape.col(j));
  }
  const Eigen::VectorXd omega = modes.frequency.head(kept);
  result.stiffness = result.mass.cwiseProduct(omega.cwiseAbs2());
  result.damping = 2.0 * damping_ratio * result.mass.cwiseProduct(omega);
  return result;
}

// Rotating damping seen by the modes of two planes.
Eigen::MatrixXd internal_damping(const RotorModes& modes, double ratio, const ScaledModes& left,
                                 const ScaledModes& right) {
  const Eigen::MatrixXd momentum = modes.ritz.mass * modes.mean.shape;
  return (left.shape.transpose() * momentum) * (2.0 * ratio * modes.mean.frequency).asDiagonal() *
         (momentum.transpose() * right.shape);
}

ModeLines lines(const BendingBasis& basis, const ScaledModes& x, const ScaledModes& y) {
  const std::vector<double> stations = line_stations(basis.mesh());
  const Eigen::Index count = static_cast<Eigen::Index>(stations.size());
  ModeLines result{Eigen::VectorXd(count), Eigen::MatrixXd(count, x.shape.cols()),
                   Eigen::MatrixXd(count, y.shape.cols())};
  for (Eigen::Index i = 0; i < count; ++i) {
    const double z = stations[static_cast<std::size_t>(i)];
    const Eigen::RowVectorXd u = basis.deflection(z);
    result.z[i] = z;
    result.x.row(i) = u * x.shape;
    result.y.row(i) = u * y.shape;
  }
  return result;
}

}  // namespace

std::vector<double> line_stations(const std::vector<ShaftElement>& mesh) {
  // At most 1/100 of the shaft and 1/8 of an element apart (k h <= 4: 12 points a wave length).
  constexpr double kShare = 100.0;
  constexpr int kParts = 8;
  const double length = mesh.back().to - mesh.front().from;
  std::vector<double> stations{mesh.front().from};
  for (const ShaftElement& element : mesh) {
    int parts = kParts;
    while (element.length() * kShare > length * parts) ++parts;
    for (int i = 1; i < parts; ++i) stations.push_back(element.from + element.length() * i / parts);
    stations.push_back(element.to);
  }
  return stations;
}

ModalRotor reduce_bending(const scene::Scene& scene, const RotorModes& modes) {
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  const RitzBending& ritz = modes.ritz;
  const std::optional<double> contact =
      scene.contact ? std::optional<double>(scene.contact->station) : std::nullopt;

  // Both planes from one computation where they are the same: the same bits.
  const ScaledModes x = scaled(ritz.basis, modes.x, modes.kept, contact);
  const ScaledModes y = ritz.isotropic ? x : scaled(ritz.basis, modes.y, modes.kept, contact);

  ModalRotor rotor;
  rotor.x = plane(ritz.mass, modes.x, x, geometry.damping_ratio);
  rotor.y = ritz.isotropic ? rotor.x : plane(ritz.mass, modes.y, y, geometry.damping_ratio);
  rotor.contact_shape = {x.contact, y.contact};

  rotor.gyroscopic = x.shape.transpose() * ritz.gyroscopic * y.shape;
  if (ritz.isotropic) {
    rotor.gyroscopic = (0.5 * (rotor.gyroscopic + rotor.gyroscopic.transpose())).eval();
    const Eigen::VectorXd internal = 2.0 * geometry.internal_damping_ratio *
                                     rotor.x.mass.cwiseProduct(modes.x.frequency.head(modes.kept));
    rotor.internal_xx = rotor.internal_xy = rotor.internal_yy = internal.asDiagonal();
  } else {
    const double ratio = geometry.internal_damping_ratio;
    rotor.internal_xx = internal_damping(modes, ratio, x, x);
    rotor.internal_xy = internal_damping(modes, ratio, x, y);
    rotor.internal_yy = internal_damping(modes, ratio, y, y);
  }

  // Stations of the scene, through the mode values there.
  const auto shape_at = [&](double z) {
    const Eigen::RowVectorXd u = ritz.basis.deflection(z);
    return ModeShape{x.shape.transpose() * u.transpose(), y.shape.transpose() * u.transpose()};
  };
  for (const scene::ShaftBearing& bearing : geometry.bearings) {
    if (bearing.damping.isZero(0.0)) continue;
    rotor.bearing_dampers.push_back({shape_at(bearing.z), bearing.damping});
  }
  for (const scene::Disc& disc : geometry.discs) {
    const double static_moment = disc.mass * disc.eccentricity;
    if (static_moment == 0.0) continue;
    rotor.unbalances.push_back({shape_at(disc.z), static_moment, disc.phase});
  }
  for (const scene::Force& force : scene.forces) {
    rotor.force_shapes.push_back(shape_at(force.station));
  }
  if (scene.magnetic_bearing) {
    rotor.magnetic_bearing_shape = shape_at(scene.magnetic_bearing->station);
  }
  rotor.gravity_x = x.shape.transpose() * ritz.gravity;
  rotor.gravity_y = y.shape.transpose() * ritz.gravity;
  rotor.lines = lines(ritz.basis, x, y);
  return rotor;
}

}  // namespace rotorub
