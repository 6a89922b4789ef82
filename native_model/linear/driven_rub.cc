#include "native_model/linear/driven_rub.h"

#include <cassert>
#include <cmath>

#include "native_model/linear/rub_stability.h"
#include "native_model/model/model.h"
#include "native_model/numerics/root.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/record.h"

namespace rotorub::rub {
namespace {

using Eigen::Index;

// Whether the load turns with the spin, with the tolerance of rotating_loads.
bool in_step(const RubSystem& s, const SteadyRub& rub) {
  return rub.kind == RubKind::kForced && std::abs(rub.whirl - s.speed) <= 1e-9 * std::abs(s.speed);
}

// Positions of the coordinates in an enlarged perturbation: n modes and the ring, as real and
// imaginary parts, then spin, torsion and the rotation of the ring.
struct Places {
  Index modes, half, phi, theta, chi, all;
  bool spin, ring_turns;
  Places(const RubSystem& s, const DriveTrain& t)
      : modes(s.modes()),
        half(modes + (s.ring ? 1 : 0)),
        phi(2 * half),
        theta(phi + (t.motor ? 1 : 0)),
        chi(theta + t.modes()),
        all(chi + (s.ring_turns() ? 1 : 0)),
        spin(t.motor.has_value()),
        ring_turns(s.ring_turns()) {}
};

// Adds to column `column` in the rows of a, real and imaginary parts.
void put(Eigen::MatrixXd& matrix, const Places& at, Index column, const Eigen::VectorXcd& values) {
  matrix.col(column).head(at.modes) += values.real();
  matrix.col(column).segment(at.half, at.modes) += values.imag();
}
// Adds Im(w^H a) to row `row`.
void put_moment(Eigen::MatrixXd& matrix, const Places& at, Index row, const Eigen::VectorXcd& w) {
  matrix.row(row).head(at.modes) -= w.imag().transpose();
  matrix.row(row).segment(at.half, at.modes) += w.real().transpose();
}

Perturbation enlarged(const Perturbation& small, Index all) {
  const Index m = small.push.cols();
  const auto grown = [](const Eigen::MatrixXd& matrix, Index rows, Index columns) {
    Eigen::MatrixXd larger = Eigen::MatrixXd::Zero(rows, columns);
    larger.topLeftCorner(matrix.rows(), matrix.cols()) = matrix;
    return larger;
  };
  return {grown(small.mass, all, all), grown(small.rates, all, all), grown(small.springs, all, all),
          grown(small.push, all, m), grown(small.constraint, m, all)};
}

// Uncoupled terms of spin, torsion and the ring's rotation: inertias, springs, dampers and the
// slope of the motor's torque.
void add_train(Perturbation& p, const Places& at, const RubSystem& s, const DriveTrain& train) {
  const Index k = train.modes();
  p.mass.diagonal().segment(at.theta, k) = train.torsion_inertia;
  p.rates.diagonal().segment(at.theta, k) = train.torsion_damping;
  p.springs.diagonal().segment(at.theta, k) = train.torsion_stiffness;
  if (at.ring_turns) {
    p.mass(at.chi, at.chi) = s.ring->inertia;
    p.rates(at.chi, at.chi) = s.ring->drag;
  }
  if (!at.spin) return;
  p.mass(at.phi, at.phi) = train.inertia;
  Eigen::VectorXd motor = Eigen::VectorXd::Zero(at.all);
  motor[at.phi] = 1.0;
  motor.segment(at.theta, k) = train.at_motor;
  p.rates -= train.motor->slope(s.speed) * motor * motor.transpose();
}

// Effect of the spin on bending and of unbalance on the spin.
void add_spin(Perturbation& p, const Places& at, const RubSystem& s, const DriveTrain& train,
              const SteadyRub& rub) {
  const Complex back = std::polar(1.0, -rub.direction);
  const bool forced = rub.kind == RubKind::kForced;
  const Eigen::VectorXcd U = (forced ? back : Complex()) * s.unbalance;
  const Eigen::VectorXcd f = (forced ? back : Complex()) * train.locked;
  const double omega = s.speed;
  put(p.mass, at, at.phi, kI * U);
  put(p.rates, at, at.phi,
      rub.whirl * (s.gyroscopic.cast<Complex>() * rub.rotor) -
          kI * (s.internal.cast<Complex>() * rub.rotor) - 2.0 * omega * U);
  put(p.springs, at, at.phi, -kI * (omega * omega * U + f));
  put_moment(p.mass, at, at.phi, U);
  put_moment(p.rates, at, at.phi,
             -2.0 * kI * omega * U);  // Im((-2 i Omega U)^H a') = 2 Omega Re(U^H a')
  put_moment(p.springs, at, at.phi, -omega * omega * U);
  p.springs(at.phi, at.phi) += omega * omega * U.dot(rub.rotor).real();
}

// Torque of the friction; for rolling, also its part in the constraint.
void add_friction(Perturbation& p, const Places& at, const RubSystem& s, const DriveTrain& train,
                  const SteadyRub& rub) {
  Eigen::VectorXd lever = Eigen::VectorXd::Zero(at.all);
  if (at.spin) lever[at.phi] = s.radius;
  lever.segment(at.theta, train.modes()) = s.radius * train.at_contact;
  if (at.ring_turns) lever[at.chi] = -s.ring_radius();
  if (!rub.rolls()) {
    p.push.col(0) += rub.friction * lever;
    // Change of the slip beyond the part that perturbation() has.
    Eigen::VectorXd bending = Eigen::VectorXd::Zero(at.all);
    bending.segment(at.half, at.half) = p.constraint.row(0).head(at.half).transpose();
    const Eigen::VectorXd slip = bending + lever;
    p.rates += slip_damping(s, rub) * (slip * slip.transpose() - bending * bending.transpose());
    return;
  }
  // The torque belongs to the force along e_t, which turns with the contact.
  p.springs -= (rub.normal_force / s.clearance) * lever * p.constraint.row(1);
  p.constraint.row(1) += lever.transpose();
  p.push.col(1) += lever;
}

// Number of arbitrary directions and angles, including the angle of a ring that turns.
int free_angles(const DriveTrain& train, const RubSystem& s, const SteadyRub& rub) {
  const int ring = s.ring_turns() ? 1 : 0;
  if (rub.kind == RubKind::kRolling)
    // Direction and spin together; theta restores a prescribed spin.
    return (train.motor ? 1 : 0) + ring;
  if (rub.kind == RubKind::kWhip) return (train.motor ? 2 : 1) + ring;
  // If all loads turn with the spin, everything may be turned together; if none does, the spin
  // alone may be. With both kinds of load no angle is free.
  const bool with_spin = !s.unbalance.isZero(0.0) || !train.locked.isZero(0.0);
  return (train.motor && !(with_spin && train.fixed) ? 1 : 0) + (rub.rolls() ? 0 : ring);
}

}  // namespace

DriveTrain drive_train(const scene::Scene& scene) {
  const Model m = model_without_start(scene);
  if (m.drive_follows()) {
    throw scene::SceneError(
        scene::placed(scene, {{"", 0, "drive.kind",
                               "no lasting rub can be analysed with a torque that depends on time "
                               "and angle; choose free, linear, kloss or table"}}));
  }
  const auto torsion = [&](const Eigen::VectorXd& all) {
    return all.segment(m.layout.theta(), m.layout.torsion);
  };
  DriveTrain train{m.drive,
                   m.layout.spin ? m.mass[m.layout.phi()] : 0.0,
                   torsion(m.mass),
                   torsion(m.damping),
                   torsion(m.stiffness),
                   m.first().torsion_shape.head(m.layout.torsion),
                   Eigen::VectorXd::Zero(m.layout.torsion),
                   Eigen::VectorXcd::Zero(m.layout.modes),
                   false};
  if (m.drive) train.at_motor = m.drive_shape.head(m.layout.torsion);
  for (const AppliedForce& force : m.forces) {
    if (force.kind == scene::ForceKind::kRotating) train.fixed = true;
    if (force.kind != scene::ForceKind::kSynchronous) continue;
    train.locked += std::polar(force.amplitude, force.phase + m.spin_angle) * force.shape.x;
  }
  return train;
}

std::vector<Complex> driven_eigenvalues(const RubSystem& s, const DriveTrain& train,
                                        const SteadyRub& rub) {
  assert(rub.kind != RubKind::kForced || s.unbalance.isZero(0.0) || in_step(s, rub));
  const Places at(s, train);
  Perturbation p = enlarged(perturbation(s, rub), at.all);
  add_train(p, at, s, train);
  if (at.spin) add_spin(p, at, s, train, rub);
  add_friction(p, at, s, train, rub);
  std::vector<Complex> values = eigenvalues(p);
  leave_out_smallest(values, free_angles(train, s, rub));
  return values;
}

double torque_taken(const RubSystem& s, const SteadyRub& rub) {
  double torque = s.radius * rub.friction * rub.normal_force;
  if (in_step(s, rub)) {
    const Complex reaction = std::polar(1.0, rub.direction) * s.unbalance.dot(rub.rotor);
    torque -= s.speed * s.speed * reaction.imag();
  }
  return torque;
}

std::vector<DrivenRolling> driven_rolling(const RubSystem& system, const DriveTrain& train,
                                          double top) {
  std::vector<DrivenRolling> all;
  if (!train.motor || top == 0.0 || system.ring_turns()) return all;
  const double ratio = system.radius / system.clearance, sense = std::copysign(1.0, top);
  const auto whirl = [&](double speed) { return -ratio * speed; };
  const auto h = [&](double speed) { return compliance(at_speed(system, speed), whirl(speed)); };
  // Motor torque minus r tau lambda = r delta_0 Im H / |H|^2.
  const auto balance = [&](double size) {
    const double speed = sense * size;
    const Complex at = h(speed);
    return train.motor->torque(speed) -
           system.radius * system.clearance * at.imag() / std::norm(at);
  };
  std::vector<double> sizes;
  std::vector<Complex> poles = joined_eigenvalues(system);
  for (const Complex& pole : free_eigenvalues(system)) poles.push_back(pole);
  for (const double nu : resonance_points(poles, 1e-3 * ratio * sense * top, ratio * sense * top)) {
    sizes.push_back(nu / ratio);
  }
  std::vector<double> left_over;
  sample_with_extremes(balance, sizes, left_over);
  for (std::size_t k = 0; k + 1 < sizes.size(); ++k) {
    const double left = left_over[k], right = left_over[k + 1];
    if (!(left * right <= 0.0) || left == 0.0) continue;
    const auto [lo, hi] = root(balance, sizes[k], sizes[k + 1], left, right);
    const double speed = sense * 0.5 * (lo + hi);
    if (!can_roll(h(speed), system.friction.sticking())) continue;
    const RubSystem turning = at_speed(system, speed);
    const auto rub = BackwardCompliance(turning).rolling(system.friction.sticking());
    if (!rub) continue;
    all.push_back({speed, *rub, torque_taken(turning, *rub),
                   stability_of(driven_eigenvalues(turning, train, *rub))});
  }
  return all;
}

}  // namespace rotorub::rub
