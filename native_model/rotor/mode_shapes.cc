#include "native_model/rotor/mode_shapes.h"

#include <algorithm>
#include <cmath>

#include "native_model/rotor/modal_reduction.h"
#include "native_model/rotor/refusal.h"
#include "native_model/rotor/rotor_modes.h"

namespace rotorub {
namespace {

std::string numbered(const char* name, std::size_t index, std::size_t count) {
  return count == 1 ? std::string(name) : std::string(name) + " " + std::to_string(index + 1);
}

std::vector<Station> stations_of(const scene::Scene& scene) {
  std::vector<Station> stations;
  const auto add_all = [&](StationKind kind, const char* name, const auto& parts, auto z) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      stations.push_back({kind, numbered(name, i, parts.size()), parts[i].*z});
    }
  };
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  add_all(StationKind::kBearing, "bearing", geometry.bearings, &scene::ShaftBearing::z);
  add_all(StationKind::kDisc, "disc", geometry.discs, &scene::Disc::z);
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const auto& contact = scene.auxiliary[k].contact;
    const std::string name = scene.auxiliary.size() > 1 ? "contact " + scene.name_of(k) : "contact";
    if (contact) stations.push_back({StationKind::kContact, name, contact->station});
  }
  if (scene.drive) stations.push_back({StationKind::kDrive, "drive", scene.drive->station});
  if (scene.magnetic_bearing) {
    stations.push_back(
        {StationKind::kMagneticBearing, "magnetic bearing", scene.magnetic_bearing->station});
  }
  add_all(StationKind::kForce, "force", scene.forces, &scene::Force::station);
  std::stable_sort(stations.begin(), stations.end(),
                   [](const Station& a, const Station& b) { return a.z < b.z; });
  return stations;
}

// lines: the modes as the model scales them. The Ritz columns have the same shape, and give the
// value at any station once they have the same size.
PlaneShapes plane_shapes(const PlaneModes& plane, const Eigen::MatrixXd& lines,
                         const Eigen::VectorXd& z, const BendingBasis& basis,
                         const Eigen::MatrixXd& columns, const std::vector<Station>& stations) {
  const Eigen::Index n = lines.cols();
  PlaneShapes result{plane.stiffness.cwiseQuotient(plane.mass).cwiseSqrt(), lines,
                     Eigen::MatrixXd(static_cast<Eigen::Index>(stations.size()), n)};
  for (Eigen::Index j = 0; j < n; ++j) {
    Eigen::Index peak = 0;
    lines.col(j).cwiseAbs().maxCoeff(&peak);
    const double factor = lines(peak, j) / basis.deflection(z[peak]).dot(columns.col(j));
    for (std::size_t i = 0; i < stations.size(); ++i) {
      result.at_stations(static_cast<Eigen::Index>(i), j) =
          factor * basis.deflection(stations[i].z).dot(columns.col(j));
    }
  }
  return result;
}

}  // namespace

std::optional<ModeShapes> mode_shapes(const scene::Scene& scene) {
  if (!scene.rotor.geometry) return std::nullopt;
  return with_place(scene, [&] {
    const RotorModes modes = rotor_modes(scene);
    const ModalRotor rotor = reduce_bending(scene, modes);
    const ModeLines& lines = *rotor.lines;
    const BendingBasis& basis = modes.ritz.basis;
    ModeShapes result{lines.z, stations_of(scene), {}, {}, modes.ritz.isotropic};
    result.x = plane_shapes(rotor.x, lines.x, lines.z, basis, modes.x.shape, result.stations);
    result.y = plane_shapes(rotor.y, lines.y, lines.z, basis, modes.y.shape, result.stations);
    return result;
  });
}

std::vector<TorsionMode> torsion_frequencies(const ModalRotor& rotor) {
  const TorsionModes& torsion = rotor.torsion;
  std::vector<TorsionMode> modes;
  for (Eigen::Index k = 0; k < torsion.inertia.size(); ++k) {
    const double frequency = std::sqrt(torsion.stiffness[k] / torsion.inertia[k]);
    modes.push_back({frequency, torsion.damping[k] / (2.0 * frequency * torsion.inertia[k])});
  }
  return modes;
}

}  // namespace rotorub
