#include "native_model/rotor/rotor_modes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <list>
#include <mutex>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/rotor/mode_truncation.h"
#include "native_model/rotor/refusal.h"
#include "native_model/scene/diagnostic.h"

namespace rotorub {

PlanarModes planar_modes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness) {
  const SymmetricModes found =
      found_by(symmetric_modes(mass, stiffness), "no eigenmodes of the shaft can be found");
  // The eigenvalues omega^-2 ascend, so the modes come in reverse order. Values lost in round-off
  // are replaced by the smallest omega^-2 that can be distinguished from zero.
  const Eigen::VectorXd compliance = found.values.reverse();
  const double least = std::numeric_limits<double>::epsilon() * compliance[0];
  if (!(least > 0.0))
    throw RotorNotSolvable("mass or stiffness of the shaft is not positive to working precision");

  PlanarModes modes;
  modes.frequency = compliance.cwiseMax(least).cwiseSqrt().cwiseInverse();
  modes.shape = found.vectors.rowwise().reverse();
  for (Eigen::Index j = 0; j < modes.shape.cols(); ++j) {
    const double norm = modes.shape.col(j).dot(mass * modes.shape.col(j));
    modes.shape.col(j) /= std::sqrt(norm);
  }
  return modes;
}

PlanarModes free_modes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
                       double reference) {
  constexpr double kFree = 1e-9;  // share of reference^2; a smaller omega^2 is round-off
  const double shift = reference * reference;
  PlanarModes modes = planar_modes(mass, stiffness + shift * mass);
  for (double& omega : modes.frequency) {
    const double square = omega * omega - shift;
    omega = square > kFree * shift ? std::sqrt(square) : 0.0;
  }
  return modes;
}

ModalSums modal_sums(const PlanarModes& modes, const Eigen::RowVectorXd& u) {
  const Eigen::VectorXd square = (u * modes.shape).cwiseAbs2().transpose();
  ModalSums sums{square, square.cwiseQuotient(modes.frequency.cwiseAbs2())};
  for (auto* sum : {&sums.mobility, &sums.flexibility}) {
    std::partial_sum(sum->begin(), sum->end(), sum->begin());
  }
  return sums;
}

MagneticSupport magnetic_support(const scene::Scene& scene, const scene::MagneticBearing& bearing) {
  if (!bearing.control) return {-bearing.pull(), 0.0, 0.0};
  const scene::BearingControl& c = *bearing.control;
  const double gain = bearing.force_per_current();
  const double stiffness = gain * c.proportional - bearing.pull();
  MagneticSupport support;
  if (c.works()) support = {stiffness, gain * c.derivative, 0.0};
  if (scene.rotor.geometry && !scene.rotor.assembled)
    support.modal_spring = std::max(0.0, stiffness);
  return support;
}

bool has_modal_springs(const scene::Scene& scene) {
  const auto& all = scene.magnetic_bearings;
  return std::any_of(all.begin(), all.end(), [&](const scene::MagneticBearing& bearing) {
    return magnetic_support(scene, bearing).modal_spring > 0.0;
  });
}

scene::RotorGeometry supported(const scene::Scene& scene) {
  scene::RotorGeometry geometry = *scene.rotor.geometry;
  for (const scene::MagneticBearing& bearing : scene.magnetic_bearings) {
    const double spring = magnetic_support(scene, bearing).modal_spring;
    if (spring > 0.0) geometry.bearings.push_back({bearing.station, {spring, spring}, {0.0, 0.0}});
  }
  return geometry;
}

namespace {

// Gyroscopic stiffening raises forward whirl, so the mesh resolves waves up to this multiple of the
// frequency at rest.
constexpr double kWhirlMargin = 2.0;

// Stations where forces may act on the shaft. Elements must end there, as at discs and bearings.
std::vector<double> loaded_stations(const scene::Scene& scene) {
  std::vector<double> stations;
  for (const Station& station : stations_of(scene)) {
    if (station.kind == StationKind::kForce || station.kind == StationKind::kMagneticBearing ||
        station.kind == StationKind::kContact)
      stations.push_back(station.z);
  }
  return stations;
}

// First guess: the highest requested frequency (rad/s) of a uniform, simply supported shaft with
// the largest diameter. With shear it lies below the frequency of a shaft that only bends and below
// the frequency of a shaft that only shears.
double pinned_frequency(const scene::RotorGeometry& geometry, int modes) {
  const double k = modes * std::numbers::pi / geometry.length;
  double diameter = 0.0;
  for (const scene::ShaftSection& section : geometry.sections) {
    diameter = std::max({diameter, section.diameter, section.outer_at(section.to)});
  }
  const double bending = 0.25 * diameter * std::sqrt(geometry.E / geometry.rho) * k * k;
  if (geometry.theory == scene::ShaftTheory::kEulerBernoulli) return bending;
  const double shear = std::sqrt(geometry.G / geometry.rho) * k;
  return bending * shear / std::hypot(bending, shear);
}

int count_below(const PlanarModes& modes, double frequency) {
  return static_cast<int>((modes.frequency.array() <= frequency).count());
}

OwnModes own_modes(const scene::Scene& scene, const RotorModes& modes) {
  const RitzBending& r = modes.ritz;
  Eigen::MatrixXd spring = Eigen::MatrixXd::Zero(r.mass.rows(), r.mass.cols());
  for (const scene::MagneticBearing& bearing : scene.magnetic_bearings) {
    const Eigen::RowVectorXd u = r.basis.deflection(bearing.station);
    spring += magnetic_support(scene, bearing).modal_spring * u.transpose() * u;
  }
  const auto without = [&](const Eigen::MatrixXd& stiffness, const PlanarModes& with) {
    return free_modes(r.mass, stiffness - spring, with.frequency[0]);
  };
  OwnModes own;
  own.x = without(r.stiffness_x, modes.x);
  own.y = r.isotropic ? own.x : without(r.stiffness_y, modes.y);
  own.mean = r.isotropic ? own.x : without(0.5 * (r.stiffness_x + r.stiffness_y), modes.mean);
  return own;
}

RotorModes solve(const scene::Scene& scene, double omega) {
  const scene::RotorGeometry geometry = supported(scene);
  RitzBending ritz =
      ritz_bending(geometry, bending_mesh(geometry, loaded_stations(scene), kWhirlMargin * omega));
  RotorModes result{std::move(ritz), {}, {}, {}};
  const RitzBending& r = result.ritz;
  result.x = planar_modes(r.mass, r.stiffness_x);
  result.y = r.isotropic ? result.x : planar_modes(r.mass, r.stiffness_y);
  result.mean =
      r.isotropic ? result.x : planar_modes(r.mass, 0.5 * (r.stiffness_x + r.stiffness_y));
  if (has_modal_springs(scene)) result.own = own_modes(scene, result);
  return result;
}

// The cache key: all numbers on which the modes depend, each list after its length. Either `wanted`
// modes or `frequency` is given; the other is 0. If a structure gets a new field, this function
// does not compile until the field is either added to the key or left out on purpose.
std::vector<double> numbers_of(const scene::Scene& scene, int wanted, double frequency) {
  const scene::RotorGeometry geometry = supported(scene);
  const std::vector<double> stations = loaded_stations(scene);
  std::vector<double> all;
  const auto add = [&](auto... numbers) { (all.push_back(numbers), ...); };
  const auto add_optional = [&](const std::optional<double>& number) {
    add(number ? 1.0 : 0.0, number.value_or(0.0));
  };
  const auto begin_list = [&](const auto& list) { add(static_cast<double>(list.size())); };

  const auto& [length, E, nu, G, rho, theory, shear_coefficient, axial_force, modes, auto_modes,
               tolerance, most, damping, internal, sections, discs, bearings] = geometry;
  add(wanted, frequency, length, E, rho, axial_force, static_cast<double>(theory));
  if (theory == scene::ShaftTheory::kTimoshenko) {
    add(G);
    add_optional(shear_coefficient);
  }
  begin_list(sections);
  for (const scene::ShaftSection& section : sections) {
    const auto& [from, to, outer, inner, end_outer, end_inner] = section;
    add(from, to, outer, inner);
    add_optional(end_outer);
    add_optional(end_inner);
  }
  begin_list(discs);
  for (const scene::Disc& disc : discs) {
    const auto& [z, mass, Jt, Jp, eccentricity, phase, outer, inner, thickness, density, unbalance,
                 grade, grade_speed] = disc;
    add(z, mass, Jt, Jp);
  }
  begin_list(bearings);
  for (const scene::ShaftBearing& bearing : bearings) {
    const auto& [z, k, c, cross_k, cross_c, offset, pedestal, journal, speed, kxx, kxy, kyx, kyy,
                 cxx, cxy, cyx, cyy] = bearing;
    add(z, k.x(), k.y(), pedestal ? 1.0 : 0.0);
    if (pedestal) add(pedestal->mass, pedestal->stiffness.x(), pedestal->stiffness.y());
  }
  begin_list(stations);
  for (const double z : stations) add(z);
  for (const scene::MagneticBearing& bearing : scene.magnetic_bearings)
    add(bearing.station, magnetic_support(scene, bearing).modal_spring);
  return all;
}

// Cache of the latest solutions. One run needs the same modes several times, and the runs of a
// comparison or a sweep seldom change the shaft. It can be used from any thread; two threads that
// need the same modes at once may both compute them.
class KnownModes {
 public:
  template <class Find>
  RotorModes at(std::vector<double> numbers, const Find& find) {
    if (auto modes = known(numbers)) return *std::move(modes);
    RotorModes modes = find();
    const std::lock_guard lock(mutex_);
    known_.emplace_front(std::move(numbers), modes);
    if (known_.size() > kMost) known_.pop_back();
    return modes;
  }

 private:
  std::optional<RotorModes> known(const std::vector<double>& numbers) {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(known_.begin(), known_.end(),
                                    [&](const Known& known) { return known.first == numbers; });
    if (found == known_.end()) return {};
    known_.splice(known_.begin(), known_, found);
    return found->second;
  }

  // Room for the iterations of modes = "auto" and as many other scenes.
  static constexpr std::size_t kMost = 8;
  using Known = std::pair<std::vector<double>, RotorModes>;
  std::mutex mutex_;
  std::list<Known> known_;  // most recent first
};

}  // namespace

double RotorModes::highest() const {
  if (kept > x.frequency.size()) return std::numeric_limits<double>::infinity();
  return kept == 0 ? 0.0 : std::max(x.frequency[kept - 1], y.frequency[kept - 1]);
}

RotorModes rotor_modes(const scene::Scene& scene) {
  assert(scene.rotor.geometry);
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;

  static KnownModes known;

  // With a given number of modes, the frequency that the mesh must resolve is found iteratively.
  const auto with_modes = [&](int count) {
    return known.at(numbers_of(scene, count, 0.0), [&] {
      return solve_refined(pinned_frequency(geometry, count), [&](double omega) {
        RotorModes result = solve(scene, omega);
        result.kept = count;
        return result;
      });
    });
  };
  if (geometry.auto_modes) return fewest_modes(scene, with_modes);
  if (geometry.modes) return with_modes(*geometry.modes);

  // With a bound on the frequency: Ritz frequencies are upper bounds, and a mesh made for the bound
  // misses no mode below it.
  assert(geometry.max_frequency);
  const double bound = *geometry.max_frequency;
  RotorModes result = known.at(numbers_of(scene, 0, bound), [&] { return solve(scene, bound); });
  result.kept = std::max(count_below(result.x, bound), count_below(result.y, bound));
  if (result.kept == 0) {
    const double lowest = std::min(result.x.frequency[0], result.y.frequency[0]);
    throw scene::SceneError({{"", 0, "rotor.max_frequency",
                              "keeps no bending mode: the lowest is at " + std::to_string(lowest) +
                                  " rad/s; give a higher frequency"}});
  }
  return result;
}

Eigen::MatrixXd modal_damping(const Eigen::MatrixXd& mass, const PlanarModes& modes, double ratio) {
  const Eigen::MatrixXd momentum = mass * modes.shape;
  return momentum * (2.0 * ratio * modes.frequency).asDiagonal() * momentum.transpose();
}

}  // namespace rotorub
