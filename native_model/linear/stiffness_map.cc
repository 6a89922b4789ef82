#include "native_model/linear/stiffness_map.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "native_model/linear/campbell.h"
#include "native_model/linear/whirl_system.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/rotor/refusal.h"

namespace rotorub {
namespace {

double sense_of(const scene::Scene& scene) { return scene.rotor.speed < 0.0 ? -1.0 : 1.0; }

// at(factor, map) computes the entry at `factor` times the scene's own stiffness.
template <class At>
StiffnessMap map_over(StiffnessMap map, const At& at) {
  constexpr int kEachWay = 24, kDecades = 3;
  for (int k = -kEachWay; k <= kEachWay; ++k) {
    const double factor = std::pow(10.0, static_cast<double>(kDecades * k) / kEachWay);
    map.stiffness.push_back(factor * map.own);
    try {
      at(factor, map);
    } catch (const RotorNotSolvable&) {
      // Such springs are beyond the range of the matrices.
    }
    map.critical.resize(map.stiffness.size());
    if (!map.ring.empty()) map.ring.resize(map.stiffness.size());
  }
  return map;
}

// ------------------------------------------------------------------ supports of the rotor
// Whether all springs, including magnets that sense elsewhere and coupling across the planes, hold
// the rotor at rest.
bool stands(const WhirlSystem& system) {
  const auto values = real_eigenvalues(planes_matrices(system, 0.0).stiffness);
  return values && std::ranges::all_of(*values, [](auto s) { return s.real() > 0.0; });
}

// harder(scene, factor) scales the stiffness in the scene.
template <class Harder>
StiffnessMap map_of_scenes(StiffnessMap::Of of, double own, const scene::Scene& scene,
                           const Harder& harder) {
  return map_over({of, 0, {}, own, {}, {}}, [&](double factor, StiffnessMap& map) {
    scene::Scene held = scene;
    harder(held, factor);
    const WhirlSystem system = whirl_system(held);
    if (of == StiffnessMap::Of::kMagnets && !stands(system)) return;
    map.critical.push_back(critical_speeds(system, sense_of(scene)));
  });
}

void add_bearings(const scene::Scene& scene, std::vector<StiffnessMap>& maps) {
  if (!scene.rotor.geometry) return;
  const auto& bearings = scene.rotor.geometry->bearings;
  if (std::ranges::any_of(bearings, &scene::ShaftBearing::follows_speed)) return;
  const auto first =
      std::ranges::find_if(bearings, [](const auto& b) { return b.stiffness.x() > 0.0; });
  if (first == bearings.end()) return;
  maps.push_back(map_of_scenes(StiffnessMap::Of::kBearings, first->stiffness.x(), scene,
                               [](scene::Scene& held, double factor) {
                                 for (auto& b : held.rotor.geometry->bearings) {
                                   b.stiffness *= factor;
                                   b.cross_stiffness *= factor;
                                 }
                               }));
}

// Net stiffness, N/m; 0 if the bearing does not hold the rotor.
double spring_of(const scene::MagneticBearing& b) {
  if (!b.control || !b.control->works()) return 0.0;
  return std::max(0.0, b.force_per_current() * b.control->proportional - b.pull());
}

void add_magnets(const scene::Scene& scene, std::vector<StiffnessMap>& maps) {
  const auto first = std::ranges::find_if(scene.magnetic_bearings,
                                          [](const auto& b) { return spring_of(b) > 0.0; });
  if (first == scene.magnetic_bearings.end()) return;
  maps.push_back(map_of_scenes(
      StiffnessMap::Of::kMagnets, spring_of(*first), scene, [](scene::Scene& held, double factor) {
        for (auto& b : held.magnetic_bearings) {
          if (const double own = spring_of(b); own > 0.0)
            b.control->proportional = (factor * own + b.pull()) / b.force_per_current();
        }
      }));
}

// ------------------------------------------------------------------ support of a ring
// M and K of one plane: the ring, then the housing of its mount.
struct RingPlane {
  Eigen::MatrixXd mass, stiffness;
};
using RingPlanes = std::array<RingPlane, 2>;

// Spring stiffness of the ring, N/m.
scene::PlanePair spring_of(const scene::AuxiliaryBearing& at) {
  const bool passive = at.controller && at.controller->kind == scene::ControllerKind::kPassive;
  return at.stator->stiffness.array() + (passive ? at.controller->stiffness : 0.0);
}

RingPlanes ring_planes(const scene::AuxiliaryBearing& at, double ring, double mount) {
  const scene::Stator& stator = *at.stator;
  const Eigen::Index n = stator.mount ? 2 : 1;
  RingPlanes planes;
  for (int k = 0; k < 2; ++k) {
    Eigen::MatrixXd &m = planes[static_cast<std::size_t>(k)].mass.setZero(n, n),
                    &c = planes[static_cast<std::size_t>(k)].stiffness.setZero(n, n);
    m(0, 0) = stator.mass[k];
    c(0, 0) = ring * spring_of(at)[k];
    if (!stator.mount) continue;
    m(1, 1) = stator.mount->mass[k];
    c(0, 1) = c(1, 0) = -c(0, 0);
    c(1, 1) = c(0, 0) + mount * stator.mount->stiffness[k];
  }
  return planes;
}

// M q'' + K q with the gyroscopic coupling G of the planes, in coordinates of unit mass, as
// critical_speeds needs it. Films may be added only if the masses of both planes are equal.
WhirlSystem of_unit_mass(const RingPlanes& planes, const Eigen::MatrixXd& gyroscopic, int kept,
                         bool isotropic) {
  const Cholesky x(planes[0].mass), y(planes[1].mass);
  const auto scaled = [](const Cholesky& left, const Eigen::MatrixXd& a, const Cholesky& right) {
    const Eigen::MatrixXd half = left.solve_lower(a);
    const Eigen::MatrixXd whole = right.solve_lower(Eigen::MatrixXd(half.transpose())).transpose();
    return a == a.transpose() && &left == &right
               ? Eigen::MatrixXd(0.5 * (whole + whole.transpose()))
               : whole;
  };
  WhirlSystem system;
  system.stiffness_x = scaled(x, planes[0].stiffness, x);
  system.stiffness_y = scaled(y, planes[1].stiffness, y);
  system.gyroscopic = isotropic ? scaled(x, gyroscopic, x) : scaled(x, gyroscopic, y);
  system.kept = kept;
  system.isotropic = isotropic;
  return system;
}

bool same(const RingPlanes& planes) {
  return planes[0].mass == planes[1].mass && planes[0].stiffness == planes[1].stiffness;
}

WhirlSystem alone(const RingPlanes& ring) {
  const Eigen::Index n = ring[0].mass.rows();
  return of_unit_mass(ring, Eigen::MatrixXd::Zero(n, n), static_cast<int>(n), same(ring));
}

// The rotor's centre at the contact equals the ring's: (ring, housing) = B (rotor, housing).
WhirlSystem joined(const WhirlSystem& rotor, const ModeShape& contact, const RingPlanes& ring) {
  const Eigen::Index n = rotor.size(), behind = ring[0].mass.rows() - 1;
  const auto widened = [&](const Eigen::MatrixXd& a) {
    Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(n + behind, n + behind);
    wide.topLeftCorner(n, n) = a;
    return wide;
  };
  RingPlanes both;
  for (std::size_t k = 0; k < 2; ++k) {
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(1 + behind, n + behind);
    b.row(0).head(n) = k == 0 ? contact.x : contact.y;
    b.bottomRightCorner(behind, behind).setIdentity();
    both[k].mass = widened(Eigen::MatrixXd::Identity(n, n)) + projected(ring[k].mass, b);
    both[k].stiffness =
        widened(k == 0 ? rotor.stiffness_x : rotor.stiffness_y) + projected(ring[k].stiffness, b);
  }
  WhirlSystem system =
      of_unit_mass(both, widened(rotor.gyroscopic), rotor.kept + static_cast<int>(behind),
                   rotor.isotropic && same(ring) && contact.x == contact.y);
  const Cholesky mass(both[0].mass);
  for (const WhirlFilm& film : rotor.films) {
    Eigen::VectorXd station = Eigen::VectorXd::Zero(n + behind);
    station.head(n) = film.station;
    system.films.push_back({mass.solve_lower(station), film.law});
  }
  return system;
}

void add_ring(const scene::Scene& scene, std::size_t contact, std::vector<StiffnessMap>& maps) {
  const scene::AuxiliaryBearing& at = scene.auxiliary[contact];
  if (!at.contact || !at.stator || at.stator->ball_bearing || at.stator->dry_friction) return;
  const scene::PlanePair spring = spring_of(at);
  if (!(spring.minCoeff() > 0.0)) return;
  if (at.stator->mount && !(at.stator->mount->stiffness.minCoeff() > 0.0)) return;
  const WhirlSystem rotor = whirl_system(scene);
  if (!rotor.films.empty() && at.stator->mass.x() != at.stator->mass.y()) return;
  const auto add = [&](StiffnessMap::Of of, double own) {
    const bool mount = of == StiffnessMap::Of::kMount;
    maps.push_back(map_over({of, contact, {}, own, {}, {}}, [&](double factor, StiffnessMap& map) {
      const RingPlanes ring = ring_planes(at, mount ? 1.0 : factor, mount ? factor : 1.0);
      map.critical.push_back(
          critical_speeds(joined(rotor, rotor.contacts[contact], ring), sense_of(scene)));
      map.ring.push_back(critical_speeds(alone(ring)));
    }));
  };
  add(StiffnessMap::Of::kRing, spring.x());
  if (at.stator->mount) add(StiffnessMap::Of::kMount, at.stator->mount->stiffness.x());
}

}  // namespace

std::vector<StiffnessMap> stiffness_maps(const scene::Scene& scene) {
  std::vector<StiffnessMap> maps;
  add_bearings(scene, maps);
  add_magnets(scene, maps);
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) add_ring(scene, k, maps);
  return maps;
}

}  // namespace rotorub
