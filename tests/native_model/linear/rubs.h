// Rotors of several modes on a ring, starts on their lasting rubs, and the exponents of a measured
// decay or growth.
#pragma once

#include <Eigen/Core>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "native_model/linear/rub_system.h"
#include "native_model/linear/steady_rub.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/scene/scene.h"
#include "tests/support/jeffcott.h"

namespace rotorub::test {

// Three modes with gyroscopics, rotating damping and a magnetic bearing, spin held at 50 Hz, a
// force in step with it through mode values of its own.
inline scene::Scene three_modes(bool elastic_ring) {
  scene::Scene s = make_scene({.friction = 0.2, .speed = 100.0 * std::numbers::pi});
  scene::RotorModal& r = *s.rotor.modal;
  r.mass = {2.0, 0.8, 0.5};
  r.stiffness = {2e5, 3e6, 1.1e7};
  r.damping = {40.0, 60.0, 90.0};
  r.internal_damping = {5.0, 20.0, 0.0};
  r.gyroscopic = {0.3, -0.1, 0.2};
  s.magnetic_bearings = {scene::MagneticBearing{0.0, {0.9, 0.4, -0.6}, 2e4}};
  if (elastic_ring) add_ring(s, 1.0, 200.0, 1e6);
  add_rotating_force(s, 250.0, s.rotor.speed, 0.7);
  s.forces.back().shape = {0.8, -0.5, 0.3};
  return s;
}

// Its friction falls over the slips of a rub there, some 15 m/s, or grows.
inline FrictionLaw falling(double viscous = 0.0) {
  FrictionLaw law = 0.12;
  law.excess = 0.3;
  law.stribeck_speed = 12.0;
  law.viscous = viscous;
  return law;
}

// The scene started on the rub.
inline scene::Scene started_on(scene::Scene s, const rub::SteadyRub& rub) {
  const rub::Complex direction = std::polar(1.0, rub.direction), rate(0.0, rub.whirl);
  scene::Initial& start = s.initial;
  start.x.clear(), start.y.clear(), start.vx.clear(), start.vy.clear();
  for (const rub::Complex& turned : rub.rotor) {
    const rub::Complex place = direction * turned, velocity = rate * place;
    start.x.push_back(place.real());
    start.y.push_back(place.imag());
    start.vx.push_back(velocity.real());
    start.vy.push_back(velocity.imag());
  }
  const rub::Complex ring = direction * rub.ring, ring_velocity = rate * ring;
  if (auto& moving = s.first().stator) {
    moving->position = {ring.real(), ring.imag()};
    moving->velocity = {ring_velocity.real(), ring_velocity.imag()};
  }
  return s;
}

// Exponents s_j of x_k = sum c_j e^{s_j k step}, of `count` terms, by the matrix pencil without
// initial values. By falling real part.
inline std::vector<rub::Complex> exponents(const std::vector<double>& x, double step,
                                           Eigen::Index count) {
  const auto all = static_cast<Eigen::Index>(x.size()), wide = all / 2;
  Eigen::MatrixXd now(all - wide, wide), next(all - wide, wide);
  for (Eigen::Index i = 0; i < all - wide; ++i) {
    for (Eigen::Index j = 0; j < wide; ++j) {
      now(i, j) = x[static_cast<std::size_t>(i + j)];
      next(i, j) = i + j + 1 < all ? x[static_cast<std::size_t>(i + j + 1)] : 0.0;
    }
  }
  now.conservativeResize(all - wide - 1, wide);
  next.conservativeResize(all - wide - 1, wide);
  // Jacobi's method, because the matrices are small, and the other method takes a minute to
  // compile.
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(now, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::MatrixXd pencil = svd.singularValues().head(count).cwiseInverse().asDiagonal() *
                                 svd.matrixU().leftCols(count).transpose() * next *
                                 svd.matrixV().leftCols(count);
  std::vector<rub::Complex> found = real_eigenvalues(pencil).value();
  for (rub::Complex& z : found) z = std::log(z) / step;
  std::sort(found.begin(), found.end(),
            [](const rub::Complex& a, const rub::Complex& b) { return a.real() > b.real(); });
  return found;
}

}  // namespace rotorub::test
