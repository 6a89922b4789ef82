#include "native_model/rotor/modal_reduction.h"

#include <Eigen/Core>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "native_model/numerics/linear_solve.h"
#include "native_model/scene/scene.h"

namespace rotorub {
namespace {

constexpr double kNode = 1e-6;  // share of the largest value below which the contact is at a node
constexpr double kTie = 1e-6;   // relative; peaks that are equal by symmetry differ by less

// Position of the peak of |value| in [left, right], by golden-section search.
double peak_between(const std::function<double(double)>& value, double left, double right) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSteps = 40;  // to 4e-9 of the interval; the value is then accurate to round-off
  for (int step = 0; step < kSteps; ++step) {
    const double a = right - kGolden * (right - left);
    const double b = left + kGolden * (right - left);
    if (std::abs(value(a)) < std::abs(value(b))) {
      left = a;
    } else {
      right = b;
    }
  }
  return 0.5 * (left + right);
}

// The signed value where |value| is largest; the first of equal ones.
double largest(const std::function<double(double)>& value, const std::vector<double>& stations) {
  std::vector<double> values;
  double bound = 0.0;
  for (double z : stations) {
    values.push_back(value(z));
    bound = std::max(bound, std::abs(values.back()));
  }
  // A peak between two stations is at most this much higher, because the stations are close.
  constexpr double kNearPeak = 0.9;
  double best = 0.0;
  const std::size_t n = stations.size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool local_peak = (i == 0 || std::abs(values[i]) >= std::abs(values[i - 1])) &&
                            (i + 1 == n || std::abs(values[i]) >= std::abs(values[i + 1]));
    if (!local_peak || std::abs(values[i]) < kNearPeak * bound) continue;
    double peak = values[i];
    if (i > 0 && i + 1 < n) {
      const double between = value(peak_between(value, stations[i - 1], stations[i + 1]));
      if (std::abs(between) > std::abs(peak)) peak = between;
    }
    if (std::abs(peak) > (1.0 + kTie) * std::abs(best)) best = peak;
  }
  return best;
}

// Scaled modes of one plane; the columns are Ritz coordinates.
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

// Rotating damping, projected onto the modes of the planes.
void set_internal_damping(const RitzBending& ritz, const PlanarModes& mean, double ratio,
                          const ScaledModes& x, const ScaledModes& y, ModalRotor& rotor) {
  const Eigen::MatrixXd momentum = ritz.mass * mean.shape;
  const auto internal = [&](const ScaledModes& left, const ScaledModes& right) -> Eigen::MatrixXd {
    return (left.shape.transpose() * momentum) * (2.0 * ratio * mean.frequency).asDiagonal() *
           (momentum.transpose() * right.shape);
  };
  rotor.internal_xx = internal(x, x);
  rotor.internal_xy = ritz.isotropic ? rotor.internal_xx : internal(x, y);
  rotor.internal_yy = ritz.isotropic ? rotor.internal_xx : internal(y, y);
}

// Columns a_i and numbers d_i >= 0 such that sum d_i a_i a_i^T = `damping`, which is positive
// semidefinite.
struct RankOnes {
  Eigen::MatrixXd shape;
  Eigen::VectorXd size;
};
RankOnes rank_ones(const Eigen::MatrixXd& damping) {
  const LdltFactors factors = ldlt_factors(damping);
  return {factors.lower, factors.d.cwiseMax(0.0)};
}

// Adds the damping of the shaft's own modes. It is not diagonal in the modal coordinates, so the
// external part is added as dashpots.
void add_own_damping(const RotorModes& modes, double ratio, double internal_ratio,
                     const ScaledModes& x, const ScaledModes& y, ModalRotor& rotor) {
  const Eigen::MatrixXd& mass = modes.ritz.mass;
  const OwnModes& own = *modes.own;
  set_internal_damping(modes.ritz, own.mean, internal_ratio, x, y, rotor);
  rotor.x.damping.setZero();
  rotor.y.damping.setZero();
  if (ratio == 0.0) return;
  const auto external = [&](const PlanarModes& of, const ScaledModes& plane) {
    return rank_ones(plane.shape.transpose() * modal_damping(mass, of, ratio) * plane.shape);
  };
  const RankOnes in_x = external(own.x, x);
  const RankOnes in_y = modes.ritz.isotropic ? in_x : external(own.y, y);
  for (Eigen::Index i = 0; i < in_x.size.size(); ++i) {
    rotor.bearing_dampers.push_back(
        {{in_x.shape.col(i), in_y.shape.col(i)}, {in_x.size[i], in_y.size[i]}});
  }
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

ModeScale mode_scale(const std::function<double(double)>& value,
                     const std::vector<double>& stations, std::optional<double> contact) {
  assert(stations.size() >= 2);
  const double peak = largest(value, stations);
  if (!contact) return {1.0 / peak, 1.0};
  const double at_contact = value(*contact);
  if (std::abs(at_contact) < kNode * std::abs(peak)) return {1.0 / peak, 0.0};
  return {1.0 / at_contact, 1.0};
}

std::optional<double> contact_station(const scene::Scene& scene) {
  if (!scene.has_contact()) return std::nullopt;
  return scene.first().contact->station;
}

std::vector<double> line_stations(const std::vector<ShaftElement>& mesh) {
  // At most 1/100 of the shaft and 1/8 of an element apart (k h <= 4: 12 points per wavelength).
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
  const std::optional<double> contact = contact_station(scene);

  // If both planes are equal, they share one computation, so that their bits are equal too.
  const ScaledModes x = scaled(ritz.basis, modes.x, modes.kept, contact);
  const ScaledModes y = ritz.isotropic ? x : scaled(ritz.basis, modes.y, modes.kept, contact);

  ModalRotor rotor;
  rotor.x = plane(ritz.mass, modes.x, x, geometry.damping_ratio);
  rotor.y = ritz.isotropic ? rotor.x : plane(ritz.mass, modes.y, y, geometry.damping_ratio);

  rotor.gyroscopic = x.shape.transpose() * ritz.gyroscopic * y.shape;
  if (ritz.isotropic) {
    rotor.gyroscopic = (0.5 * (rotor.gyroscopic + rotor.gyroscopic.transpose())).eval();
    const Eigen::VectorXd internal = 2.0 * geometry.internal_damping_ratio *
                                     rotor.x.mass.cwiseProduct(modes.x.frequency.head(modes.kept));
    rotor.internal_xx = rotor.internal_xy = rotor.internal_yy = internal.asDiagonal();
  } else {
    set_internal_damping(ritz, modes.mean, geometry.internal_damping_ratio, x, y, rotor);
  }
  if (modes.own) {
    add_own_damping(modes, geometry.damping_ratio, geometry.internal_damping_ratio, x, y, rotor);
  }

  const auto shape_of = [&](const Eigen::RowVectorXd& u) {
    return ModeShape{x.shape.transpose() * u.transpose(), y.shape.transpose() * u.transpose()};
  };
  const auto shape_at = [&](double z) { return shape_of(ritz.basis.deflection(z)); };
  rotor.contacts = {{x.contact, y.contact}};
  for (std::size_t k = 1; k < scene.auxiliary.size(); ++k) {
    rotor.contacts.push_back(shape_at(scene.auxiliary[k].contact->station));
  }
  for (std::size_t i = 0; i < geometry.bearings.size(); ++i) {
    const scene::ShaftBearing& bearing = geometry.bearings[i];
    const auto& [relative, pedestal] = ritz.bearings[i];
    const ModeShape at = shape_of(relative);
    if (bearing.pedestal && !bearing.pedestal->damping.isZero(0.0))
      rotor.bearing_dampers.push_back({shape_of(pedestal), bearing.pedestal->damping});
    if (!bearing.damping.isZero(0.0)) rotor.bearing_dampers.push_back({at, bearing.damping});
    if (auto film = film_of(bearing)) rotor.films.push_back({at, std::move(*film)});
    if (bearing.offset.isZero(0.0)) continue;
    if (rotor.pull_x.size() == 0)
      rotor.pull_x = rotor.pull_y = Eigen::VectorXd::Zero(rotor.modes());
    rotor.pull_x += bearing.stiffness.x() * bearing.offset.x() * at.x;
    rotor.pull_y += bearing.stiffness.y() * bearing.offset.y() * at.y;
  }
  for (const scene::Disc& disc : geometry.discs) {
    const double static_moment = disc.mass * disc.eccentricity;
    if (static_moment == 0.0) continue;
    rotor.unbalances.push_back({shape_at(disc.z), static_moment, disc.phase});
  }
  for (const scene::Force& force : scene.forces) {
    rotor.force_shapes.push_back(shape_at(force.station));
  }
  for (const scene::MagneticBearing& bearing : scene.magnetic_bearings) {
    MagnetShapes& at = rotor.magnets.emplace_back(MagnetShapes{shape_at(bearing.station)});
    if (bearing.sensor_station) at.sensor = shape_at(*bearing.sensor_station);
  }
  rotor.gravity_x = x.shape.transpose() * ritz.gravity;
  rotor.gravity_y = y.shape.transpose() * ritz.gravity;
  rotor.lines = lines(ritz.basis, x, y);
  return rotor;
}

}  // namespace rotorub
