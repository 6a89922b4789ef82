// A machine with every part at once and all numbers different, so that no term can compensate
// another. It is small enough to implement its mechanics a second time.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <random>

#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/scene.h"

namespace rotorub::test {

// Modal form: two anisotropic bending modes; two torsion modes; linear drive or prescribed speed.
inline scene::Scene machine_scene(bool with_drive) {
  scene::Scene s;
  s.name = "machine";
  s.rotor.speed = 310.0;
  scene::RotorModal modal;
  modal.mass = {2.0, 0.8};
  modal.mass_y = {2.2, 0.7};
  modal.stiffness = {2.0e5, 3.0e6};
  modal.stiffness_y = {1.6e5, 2.5e6};
  modal.damping = {40.0, 60.0};
  modal.damping_y = {30.0, 70.0};
  modal.internal_damping = {15.0, 8.0};
  modal.gyroscopic = {0.05, -0.02};
  modal.inertia = 1e-3;
  s.rotor.modal = modal;
  scene::Torsion torsion;
  torsion.inertia = {4e-4, 1e-4};
  torsion.stiffness = {60.0, 90.0};
  torsion.damping = {0.01, 0.02};
  torsion.drive_shape = {0.3, -0.5};
  s.rotor.torsion = torsion;
  if (with_drive) {
    scene::Drive drive;
    drive.kind = scene::DriveKind::kLinear;
    drive.gain = 0.05;
    drive.speed = 330.0;
    s.drive = drive;
  }
  scene::Force rotating;
  rotating.kind = scene::ForceKind::kRotating;
  rotating.amplitude = 90.0;
  rotating.frequency = 290.0;
  rotating.phase = 0.4;
  rotating.shape = {0.9, -0.6};
  scene::Force constant;
  constant.kind = scene::ForceKind::kConstant;
  constant.vector = {12.0, -25.0};
  constant.shape = {1.1, 0.2};
  s.forces = {rotating, constant};
  s.magnetic_bearings = {scene::MagneticBearing{0.0, {0.8, -1.3}, 3e4}};
  scene::Contact contact;
  contact.radius = 0.05;
  contact.clearance = 0.5e-3;
  contact.friction = 0.2;
  contact.restitution = 0.5;
  s.first().contact = contact;
  s.first().stator = scene::Stator{{1.5, 1.2}, {200.0, 150.0}, {1.0e5, 1.4e5}};
  s.gravity = scene::Gravity{{0.5, -9.81}, {}};
  return s;
}

// The same with the properties that only a shaft in geometry form has: eccentric discs, bearing
// dampers, and mode matrices that are neither diagonal nor symmetric.
inline Model machine(bool with_drive) {
  Model m = prepare(machine_scene(with_drive));
  const auto shape = [](double x1, double x2, double y1, double y2) {
    return ModeShape{Eigen::Vector2d(x1, x2), Eigen::Vector2d(y1, y2)};
  };
  // Large enough to couple spin and bending strongly: sum b^2 / m is up to half the inertia.
  m.unbalances = {{shape(1.2, 0.4, 1.1, 0.5), 1.5e-2, 0.3},
                  {shape(0.6, -1.0, 0.7, -0.9), 8e-3, 2.1}};
  m.dampers = {{shape(0.3, 0.7, 0.2, 0.8), {25.0, 35.0}}};
  m.gyroscopic = ModeMatrix(Eigen::Matrix2d{{0.05, 0.011}, {-0.007, -0.02}});
  m.internal_xx = ModeMatrix(Eigen::Matrix2d{{15.0, 2.0}, {2.0, 8.0}});
  m.internal_yy = ModeMatrix(Eigen::Matrix2d{{14.0, 1.5}, {1.5, 9.0}});
  m.internal_xy = ModeMatrix(Eigen::Matrix2d{{14.5, 1.7}, {1.9, 8.5}});
  // Out of date; must not be used.
  m.first().admittance.setConstant(std::numeric_limits<double>::quiet_NaN());
  return m;
}

// A state with magnitudes as in a rub; equal for equal seeds.
inline State random_state(const Model& m, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Layout& l = m.layout;
  State s{0.01 * std::abs(unit(random)), Eigen::VectorXd(m.nq()), Eigen::VectorXd(m.nq())};
  for (int i = 0; i < m.nq(); ++i) {
    const bool turns = i >= l.phi() && i < l.ring();
    s.q[i] = (turns ? 0.5 : 2e-4) * unit(random);
    s.v[i] = (turns ? 50.0 : 0.2) * unit(random);
  }
  if (l.spin) s.v[l.phi()] += 300.0;
  return s;
}

// Kinetic energy, J, implemented a second time, from bodies with their centres of mass. A disc of
// mass m whose centre is off the shaft by e has m/2 |r' + e phi'|^2; the parts that the modes (m/2
// |r'|^2) and the spin inertia (m/2 (e phi')^2) already contain are subtracted.
inline double kinetic_energy(const Model& m, const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  const Layout& l = m.layout;
  double e = 0.5 * v.dot(m.mass.cwiseProduct(v));
  if (!l.spin) return e;
  for (const DiscUnbalance& u : m.unbalances) {
    const double mass = 1.7, arm = u.static_moment / mass;
    const double angle = q[l.phi()] + u.phase, spin = v[l.phi()];
    const Eigen::Vector2d shaft{u.shape.x.dot(v.segment(l.x(), l.modes)),
                                u.shape.y.dot(v.segment(l.y(), l.modes))};
    const Eigen::Vector2d centre =
        shaft + arm * spin * Eigen::Vector2d(-std::sin(angle), std::cos(angle));
    e += 0.5 * mass * (centre.squaredNorm() - shaft.squaredNorm() - arm * arm * spin * spin);
  }
  return e;
}

// M(phi) from second differences of the kinetic energy, which is quadratic, so they are exact.
inline Eigen::MatrixXd mass_matrix(const Model& m, const State& s) {
  const int n = m.nq();
  const auto energy = [&](const Eigen::VectorXd& v) { return kinetic_energy(m, s.q, v); };
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd mass(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      mass(i, j) = energy(unit.col(i) + unit.col(j)) - energy(unit.col(i)) - energy(unit.col(j));
    }
  }
  return mass;
}

}  // namespace rotorub::test
