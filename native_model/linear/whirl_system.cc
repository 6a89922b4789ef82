#include "native_model/linear/whirl_system.h"

#include <algorithm>
#include <cassert>
#include <complex>
#include <utility>

#include "native_model/rotor/refusal.h"
#include "native_model/rotor/rotor_modes.h"

namespace rotorub {
namespace {

bool same_planes(const WhirlSystem& s) {
  return s.stiffness_x == s.stiffness_y && s.damping_x == s.damping_y &&
         s.internal_xx == s.internal_yy && s.internal_xx == s.internal_xy &&
         s.gyroscopic == s.gyroscopic.transpose() &&
         std::all_of(s.films.begin(), s.films.end(), [](const WhirlFilm& film) {
           return isotropic(film.law.constant) &&
                  (!film.law.follows() || film.law.table->isotropic());
         });
}

// Adds a support at a station, in each plane; ux, uy: values of the coordinates there.
void add_support(const Eigen::VectorXd& ux, const Eigen::VectorXd& uy,
                 const Eigen::Vector2d& stiffness, const Eigen::Vector2d& damping,
                 WhirlSystem& system) {
  system.stiffness_x += stiffness.x() * ux * ux.transpose();
  system.stiffness_y += stiffness.y() * uy * uy.transpose();
  system.damping_x += damping.x() * ux * ux.transpose();
  system.damping_y += damping.y() * uy * uy.transpose();
}

// Adds a magnetic bearing beyond its spring `modal_spring`. At its station u, with the sensor at s,
// the force is
//   -(-k_s u^T r + k_i (P s^T r + D s^T r')); with s = u it is a spring and a damper.
void add_magnets(const scene::Scene& scene, const scene::MagneticBearing& bearing,
                 const Eigen::VectorXd (&u)[2], const Eigen::VectorXd (&s)[2],
                 WhirlSystem& system) {
  const MagneticSupport support = magnetic_support(scene, bearing);
  const double rest = support.stiffness - support.modal_spring;
  if (!bearing.senses_elsewhere() || !bearing.control || !bearing.control->works()) {
    return add_support(u[0], u[1], {rest, rest}, {support.damping, support.damping}, system);
  }
  const double own = -(bearing.pull() + support.modal_spring);
  add_support(u[0], u[1], {own, own}, {0.0, 0.0}, system);
  const double spring = bearing.force_per_current() * bearing.control->proportional;
  system.stiffness_x += spring * u[0] * s[0].transpose();
  system.stiffness_y += spring * u[1] * s[1].transpose();
  system.damping_x += support.damping * u[0] * s[0].transpose();
  system.damping_y += support.damping * u[1] * s[1].transpose();
}

// The untruncated model: its coordinates are all modes of the mean stiffness, with unit mass.
WhirlSystem geometry_system(const scene::Scene& scene) {
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  const RotorModes modes = rotor_modes(scene);
  const RitzBending& ritz = modes.ritz;
  const Eigen::MatrixXd& phi = modes.mean.shape;
  const Eigen::VectorXd& omega = modes.mean.frequency;
  const auto in_modes = [&](const Eigen::MatrixXd& matrix) { return projected(matrix, phi); };
  const auto values_of = [&](const Eigen::RowVectorXd& u) -> Eigen::VectorXd {
    return (u * phi).transpose();
  };
  const auto values_at = [&](double z) { return values_of(ritz.basis.deflection(z)); };

  WhirlSystem system;
  system.kept = modes.kept;
  system.gyroscopic = in_modes(ritz.gyroscopic);
  system.internal_xx = (2.0 * geometry.internal_damping_ratio * omega).asDiagonal();
  system.internal_xy = system.internal_yy = system.internal_xx;
  if (ritz.isotropic) {
    system.stiffness_x = system.stiffness_y = omega.cwiseAbs2().asDiagonal();
    system.damping_x = system.damping_y = (2.0 * geometry.damping_ratio * omega).asDiagonal();
  } else {
    // K_x = mean + half the difference, which comes from the bearings alone.
    const Eigen::MatrixXd half = in_modes(0.5 * (ritz.stiffness_x - ritz.stiffness_y));
    const Eigen::MatrixXd mean = omega.cwiseAbs2().asDiagonal();
    system.stiffness_x = mean + half;
    system.stiffness_y = mean - half;
    system.damping_x = in_modes(modal_damping(ritz.mass, modes.x, geometry.damping_ratio));
    system.damping_y = in_modes(modal_damping(ritz.mass, modes.y, geometry.damping_ratio));
  }

  if (modes.own) {
    const auto damping = [&](const PlanarModes& of, double ratio) {
      return in_modes(modal_damping(ritz.mass, of, ratio));
    };
    system.damping_x = damping(modes.own->x, geometry.damping_ratio);
    system.damping_y =
        ritz.isotropic ? system.damping_x : damping(modes.own->y, geometry.damping_ratio);
    system.internal_xx = damping(modes.own->mean, geometry.internal_damping_ratio);
    system.internal_xy = system.internal_yy = system.internal_xx;
  }

  // Dampers of the bearings, and the magnetic bearings, at their stations.
  for (std::size_t i = 0; i < geometry.bearings.size(); ++i) {
    const scene::ShaftBearing& bearing = geometry.bearings[i];
    const Eigen::VectorXd u = values_of(ritz.bearings[i].relative);
    if (bearing.pedestal) {
      const Eigen::VectorXd p = values_of(ritz.bearings[i].pedestal);
      add_support(p, p, {0.0, 0.0}, bearing.pedestal->damping, system);
    }
    add_support(u, u, {0.0, 0.0}, bearing.damping, system);
    if (auto film = film_of(bearing)) system.films.push_back({u, std::move(*film)});
  }
  for (const scene::MagneticBearing& bearing : scene.magnetic_bearings) {
    const Eigen::VectorXd u = values_at(bearing.station),
                          s = values_at(bearing.sensor_station.value_or(bearing.station));
    add_magnets(scene, bearing, {u, u}, {s, s}, system);
  }
  for (const scene::AuxiliaryBearing& at : scene.auxiliary) {
    const Eigen::VectorXd u = values_at(at.contact ? at.contact->station : 0.0);
    system.contacts.push_back({u, u});
  }
  return system;
}

// The coordinates are the given modes, divided by the square roots of their masses.
WhirlSystem modal_system(const scene::Scene& scene) {
  const ModalRotor rotor = modal_rotor(scene);
  const Eigen::VectorXd sx = rotor.x.mass.cwiseSqrt().cwiseInverse();
  const Eigen::VectorXd sy = rotor.y.mass.cwiseSqrt().cwiseInverse();
  const auto scaled = [](const Eigen::VectorXd& left, const Eigen::MatrixXd& matrix,
                         const Eigen::VectorXd& right) {
    return Eigen::MatrixXd(left.asDiagonal() * matrix * right.asDiagonal());
  };

  WhirlSystem system;
  system.kept = rotor.modes();
  system.stiffness_x = rotor.x.stiffness.cwiseQuotient(rotor.x.mass).asDiagonal();
  system.stiffness_y = rotor.y.stiffness.cwiseQuotient(rotor.y.mass).asDiagonal();
  system.damping_x = rotor.x.damping.cwiseQuotient(rotor.x.mass).asDiagonal();
  system.damping_y = rotor.y.damping.cwiseQuotient(rotor.y.mass).asDiagonal();
  system.gyroscopic = scaled(sx, rotor.gyroscopic, sy);
  system.internal_xx = scaled(sx, rotor.internal_xx, sx);
  system.internal_xy = scaled(sx, rotor.internal_xy, sy);
  system.internal_yy = scaled(sy, rotor.internal_yy, sy);
  for (const ModeShape& c : rotor.contacts) {
    system.contacts.push_back({c.x.cwiseProduct(sx), c.y.cwiseProduct(sy)});
  }
  for (std::size_t k = 0; k < scene.magnetic_bearings.size(); ++k) {
    const ModeShape& u = rotor.magnets[k].station;
    const ModeShape s = rotor.magnets[k].sensor.value_or(u);
    add_magnets(scene, scene.magnetic_bearings[k], {u.x.cwiseProduct(sx), u.y.cwiseProduct(sy)},
                {s.x.cwiseProduct(sx), s.y.cwiseProduct(sy)}, system);
  }
  return system;
}

}  // namespace

// r = x + i y: r'' + (D + N - i Omega G) r' + (K - i Omega N) r = 0. A film with k_xx = k_yy and
// k_xy = -k_yx adds (k_xx - i k_xy) r.
WhirlMatrices isotropic_matrices(const WhirlSystem& system, double speed) {
  using Complex = std::complex<double>;
  const Complex turn(0.0, speed);
  WhirlMatrices m{
      (system.damping_x + system.internal_xx).cast<Complex>() - turn * system.gyroscopic,
      system.stiffness_x.cast<Complex>() - turn * system.internal_xx};
  for (const WhirlFilm& film : system.films) {
    const BearingCoefficients c = film.law.at(speed);
    const Eigen::MatrixXcd uu = (film.station * film.station.transpose()).cast<Complex>();
    m.stiffness += Complex(c[0], -c[1]) * uu;
    m.damping += Complex(c[4], -c[5]) * uu;
  }
  return m;
}

PlanesMatrices planes_matrices(const WhirlSystem& system, double speed) {
  const Eigen::Index n = system.size();
  PlanesMatrices m{Eigen::MatrixXd(2 * n, 2 * n), Eigen::MatrixXd(2 * n, 2 * n)};
  m.damping << system.damping_x + system.internal_xx, speed * system.gyroscopic,
      -speed * system.gyroscopic.transpose(), system.damping_y + system.internal_yy;
  m.stiffness << system.stiffness_x, speed * system.internal_xy,
      -speed * system.internal_xy.transpose(), system.stiffness_y;
  for (const WhirlFilm& film : system.films) {
    const BearingCoefficients c = film.law.at(speed);
    const Eigen::MatrixXd uu = film.station * film.station.transpose();
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 2; ++column) {
        const auto at = static_cast<std::size_t>(2 * row + column);
        m.stiffness.block(row * n, column * n, n, n) += c[at] * uu;
        m.damping.block(row * n, column * n, n, n) += c[4 + at] * uu;
      }
    }
  }
  return m;
}

Eigen::MatrixXd projected(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  const Eigen::MatrixXd p = B.transpose() * A * B;
  return 0.5 * (p + p.transpose());
}

WhirlSystem whirl_system(const scene::Scene& scene) {
  assert(scene.rotor.geometry.has_value() != scene.rotor.modal.has_value());
  WhirlSystem system = with_place(
      scene, [&] { return scene.rotor.geometry ? geometry_system(scene) : modal_system(scene); });
  system.isotropic = same_planes(system);
  return system;
}

}  // namespace rotorub
