#include "native_model/system/dynamics.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace rotorub {
namespace {

// f += shape (fx, fy): a force at a station. Plain loops: n is small.
void add_station_force(const Layout& l, const ModeShape& shape, const Eigen::Vector2d& force,
                       double* f) {
  const double *x = shape.x.data(), *y = shape.y.data();
  for (int k = 0; k < l.modes; ++k) {
    f[k] += force.x() * x[k];
    f[l.modes + k] += force.y() * y[k];
  }
}

Eigen::Vector2d at_station(const Layout& l, const ModeShape& shape, const double* q) {
  const double *x = shape.x.data(), *y = shape.y.data();
  double sum_x = 0.0, sum_y = 0.0;
  for (int k = 0; k < l.modes; ++k) {
    sum_x += x[k] * q[k];
    sum_y += y[k] * q[l.modes + k];
  }
  return {sum_x, sum_y};
}

// Rotating damping, see modal_rotor.h: -D_i (qdot - Omega e_z x q).
void add_rotating_damping(const Model& m, const double* q, const double* v, double omega,
                          double* f) {
  const int n = m.layout.modes, x = m.layout.x(), y = m.layout.y();
  if (m.internal_xx.absent() && m.internal_yy.absent()) return;
  m.internal_xx.add(-1.0, v + x, f + x, n);
  m.internal_yy.add(-1.0, v + y, f + y, n);
  m.internal_xy.add(-omega, q + y, f + x, n);
  m.internal_xy.add_transposed(omega, q + x, f + y, n);
}

// m e Omega^2 at the disc's angle; the m e dOmega/dt part is in the mass matrix.
void add_unbalance(const Model& m, double angle, double omega, double* f) {
  for (const DiscUnbalance& u : m.unbalances) {
    const double a = angle + u.phase, size = u.static_moment * omega * omega;
    add_station_force(m.layout, u.shape, {size * std::cos(a), size * std::sin(a)}, f);
  }
}

void add_drive(const Model& m, const double* v, double* f) {
  if (!m.drive) return;
  const Layout& l = m.layout;
  double speed = v[l.phi()];
  for (int k = 0; k < l.torsion; ++k) speed += m.drive_shape[k] * v[l.theta() + k];
  const double torque = m.drive->torque(speed);
  f[l.phi()] += torque;
  for (int k = 0; k < l.torsion; ++k) f[l.theta() + k] += m.drive_shape[k] * torque;
}

// m e (-sin, cos) of each eccentric disc at the spin angle, kg m: with the mode values of its
// station the rows of M(phi) that couple the spin with the bending modes.
class UnbalanceArms {
 public:
  UnbalanceArms(const Model& m, double angle) : model_(m) {
    assert(m.unbalances.size() <= kMaxUnbalances);
    for (std::size_t i = 0; i < m.unbalances.size(); ++i) {
      const DiscUnbalance& u = m.unbalances[i];
      const double a = angle + u.phase;
      arms_[i] = u.static_moment * Eigen::Vector2d(-std::sin(a), std::cos(a));
    }
  }
  const Eigen::Vector2d& arm(std::size_t i) const { return arms_[i]; }
  // b_k of bending mode k: M holds b e_phi^T + e_phi b^T.
  Eigen::Vector2d row(int k) const {
    Eigen::Vector2d b{0.0, 0.0};
    for (std::size_t i = 0; i < model_.unbalances.size(); ++i) {
      const ModeShape& shape = model_.unbalances[i].shape;
      b += Eigen::Vector2d(arms_[i].x() * shape.x[k], arms_[i].y() * shape.y[k]);
    }
    return b;
  }

 private:
  const Model& model_;
  std::array<Eigen::Vector2d, kMaxUnbalances> arms_;
};

}  // namespace

double spin_angle(const Model& m, double t, const double* q) {
  return m.layout.spin ? q[m.layout.phi()] : m.spin_angle + m.speed * t;
}

double spin_speed(const Model& m, const double* v) {
  return m.layout.spin ? v[m.layout.phi()] : m.speed;
}

double contact_spin(const Model& m, const double* v) {
  double omega = spin_speed(m, v);
  for (int k = 0; k < m.layout.torsion; ++k) {
    omega += m.torsion_contact[k] * v[m.layout.theta() + k];
  }
  return omega;
}

void coupling_force(const Model& m, double t, const double* q, const double* v, double* f) {
  load_force(m, t, q, v, f);
  const int n = m.layout.modes, x = m.layout.x(), y = m.layout.y();
  const double omega = spin_speed(m, v);
  m.gyroscopic.add(-omega, v + y, f + x, n);
  m.gyroscopic.add_transposed(omega, v + x, f + y, n);
}

void load_force(const Model& m, double t, const double* q, const double* v, double* f) {
  const Layout& l = m.layout;
  if (m.weight.size() > 0) {
    std::copy_n(m.weight.data(), l.nq(), f);
  } else {
    std::fill_n(f, l.nq(), 0.0);
  }
  const double omega = spin_speed(m, v);
  add_rotating_damping(m, q, v, omega, f);
  for (const StationDamper& d : m.dampers) {
    add_station_force(l, d.shape, -d.damping.cwiseProduct(at_station(l, d.shape, v)), f);
  }
  for (const StationSpring& s : m.springs) {
    add_station_force(l, s.shape, -s.stiffness.cwiseProduct(at_station(l, s.shape, q)), f);
  }
  for (const AppliedForce& force : m.forces) {
    if (t >= force.on && t < force.off) add_station_force(l, force.shape, force.at(t), f);
  }
  if (!m.unbalances.empty()) add_unbalance(m, spin_angle(m, t, q), omega, f);
  add_drive(m, v, f);
}

void unactuated_force(const Model& m, double t, const double* q, const double* v, double* f) {
  coupling_force(m, t, q, v, f);
  for (int i = 0; i < m.nq(); ++i) f[i] -= m.stiffness[i] * q[i] + m.damping[i] * v[i];
}

void solve_mass(const Model& m, double t, const double* q, const double* f, double* a) {
  solve_mass(m, m.mass.data(), t, q, f, a);
}

void solve_mass(const Model& m, const double* mass, double t, const double* q, const double* f,
                double* a) {
  const Layout& l = m.layout;
  if (!m.coupled_mass()) {
    for (int i = 0; i < l.nq(); ++i) a[i] = f[i] / mass[i];
    return;
  }
  // M = diag + b e_phi^T + e_phi b^T with b in the bending rows: eliminate those.
  const UnbalanceArms arms(m, spin_angle(m, t, q));
  double torque = f[l.phi()], inertia = mass[l.phi()];
  for (int k = 0; k < l.modes; ++k) {
    const Eigen::Vector2d b = arms.row(k);
    const double mx = mass[l.x() + k], my = mass[l.y() + k];
    torque -= b.x() * f[l.x() + k] / mx + b.y() * f[l.y() + k] / my;
    inertia -= b.x() * b.x() / mx + b.y() * b.y() / my;
  }
  const double acceleration = torque / inertia;
  for (int i = 0; i < l.nq(); ++i) a[i] = f[i] / mass[i];
  a[l.phi()] = acceleration;
  for (int k = 0; k < l.modes; ++k) {
    const Eigen::Vector2d b = arms.row(k);
    a[l.x() + k] -= b.x() * acceleration / mass[l.x() + k];
    a[l.y() + k] -= b.y() * acceleration / mass[l.y() + k];
  }
}

Eigen::Vector2d rotor_point(const Model& m, const double* q) {
  return at_station(m.layout, m.contact_shape, q);
}

Eigen::Vector2d stator_point(const Model& m, const double* q) {
  if (!m.layout.stator) return {0.0, 0.0};
  return {q[m.layout.ring()], q[m.layout.ring() + 1]};
}

ContactPoint contact_point(const Model& m, const double* q, const double* v) {
  const double radius = m.contact ? m.contact->radius : 0.0;
  const double clearance = m.contact ? m.contact->clearance : 0.0;
  return contact_kinematics(rotor_point(m, q) - stator_point(m, q),
                            rotor_point(m, v) - stator_point(m, v), contact_spin(m, v), radius,
                            clearance);
}

Eigen::Matrix3d contact_admittance(const Model& m, double t, const double* q) {
  if (!m.coupled_mass()) return m.admittance;
  return contact_admittance(m, m.mass.data(), t, q);
}

Eigen::Matrix3d contact_admittance(const Model& m, const double* mass, double t, const double* q) {
  const Layout& l = m.layout;
  Eigen::Vector3d a{0.0, 0.0, 0.0};
  for (int k = 0; k < l.modes; ++k) {
    a.x() += m.contact_shape.x[k] * m.contact_shape.x[k] / mass[l.x() + k];
    a.y() += m.contact_shape.y[k] * m.contact_shape.y[k] / mass[l.y() + k];
  }
  for (int k = 0; k < l.torsion; ++k) {
    a.z() += m.torsion_contact[k] * m.torsion_contact[k] / mass[l.theta() + k];
  }
  if (l.stator) {
    a.x() += 1.0 / mass[l.ring()];
    a.y() += 1.0 / mass[l.ring() + 1];
  }
  if (!m.coupled_mass()) {
    if (l.spin) a.z() += 1.0 / mass[l.phi()];
    return a.asDiagonal();
  }
  // M^-1 = D0^-1 + w w^T / s, w = (-D^-1 b, 1), s = J - b^T D^-1 b; D0^-1 is 0 at the spin.
  const UnbalanceArms arms(m, spin_angle(m, t, q));
  double s = mass[l.phi()];
  Eigen::Vector3d jw{0.0, 0.0, 1.0};
  for (int k = 0; k < l.modes; ++k) {
    const Eigen::Vector2d b = arms.row(k);
    const double wx = -b.x() / mass[l.x() + k], wy = -b.y() / mass[l.y() + k];
    s += b.x() * wx + b.y() * wy;
    jw.x() += m.contact_shape.x[k] * wx;
    jw.y() += m.contact_shape.y[k] * wy;
  }
  Eigen::Matrix3d full = a.asDiagonal();
  full.noalias() += jw * jw.transpose() / s;
  return full;
}

void add_contact_load(const Model& m, const Eigen::Vector3d& p, double* f) {
  const Layout& l = m.layout;
  add_station_force(l, m.contact_shape, p.head<2>(), f);
  if (l.spin) f[l.phi()] += p.z();
  for (int k = 0; k < l.torsion; ++k) f[l.theta() + k] += m.torsion_contact[k] * p.z();
  if (l.stator) {
    f[l.ring()] -= p.x();
    f[l.ring() + 1] -= p.y();
  }
}

double energy(const Model& m, double t, const double* q, const double* v) {
  const Layout& l = m.layout;
  double e = 0.0;
  for (int i = 0; i < l.mechanical(); ++i) {
    e += 0.5 * (m.mass[i] * v[i] * v[i] + m.stiffness[i] * q[i] * q[i]);
  }
  for (const StationSpring& s : m.springs) {
    const Eigen::Vector2d r = at_station(l, s.shape, q);
    e += 0.5 * s.stiffness.dot(r.cwiseProduct(r));
  }
  if (m.coupled_mass()) {
    const UnbalanceArms arms(m, spin_angle(m, t, q));
    for (std::size_t i = 0; i < m.unbalances.size(); ++i) {
      e += v[l.phi()] * arms.arm(i).dot(at_station(l, m.unbalances[i].shape, v));
    }
  }
  return e;
}

double external_power(const Model& m, double t, const double* q, const double* v,
                      const Eigen::Vector2d& ring_force) {
  const Layout& l = m.layout;
  constexpr int kStack = kMaxCoordinates;
  assert(l.nq() <= kStack);
  double f[kStack];
  unactuated_force(m, t, q, v, f);
  for (int k = 0; k < l.stator; ++k) f[l.ring() + k] += ring_force[k];
  double power = 0.0;
  for (int i = 0; i < l.mechanical(); ++i) power += (f[i] + m.stiffness[i] * q[i]) * v[i];
  return power + extra_power(m, t, q, v);
}

double extra_power(const Model& m, double t, const double* q, const double* v) {
  const Layout& l = m.layout;
  double power = 0.0;
  for (const StationSpring& s : m.springs) {
    power += s.stiffness.cwiseProduct(at_station(l, s.shape, q)).dot(at_station(l, s.shape, v));
  }
  if (m.coupled_mass()) {
    // With a free spin m e Omega^2 is inertial: it moves energy between spin and bending.
    const double angle = spin_angle(m, t, q), omega = spin_speed(m, v);
    for (const DiscUnbalance& b : m.unbalances) {
      const double size = b.static_moment * omega * omega, a = angle + b.phase;
      power -= size * Eigen::Vector2d(std::cos(a), std::sin(a)).dot(at_station(l, b.shape, v));
    }
  }
  return power;
}

}  // namespace rotorub
