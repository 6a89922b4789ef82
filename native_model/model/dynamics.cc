#include "native_model/model/dynamics.h"

#include <algorithm>
#include <cmath>

#include "native_model/model/inverse_mass.h"
#include "native_model/model/loads.h"

namespace rotorub {
namespace {

namespace eq = equations;

using Angles = eq::DiscAngles;

Eigen::Vector2d vector(const eq::Pair& p) { return {p.x, p.y}; }

Eigen::Vector2d at_station(const Layout& l, const ModeShape& shape, const double* q) {
  return vector(eq::at_station(l.modes, shape, q));
}

Angles angles_at(const Model& m, double t, const double* q) {
  Angles angles;
  if (!m.unbalances.empty()) angles.fill(m, t, q);
  return angles;
}

Eigen::Vector2d pair_at(const double* x, int at) {
  return at == kAbsent ? Eigen::Vector2d(0.0, 0.0) : Eigen::Vector2d(x[at], x[at + 1]);
}

// Adds all loads except the diagonal ones, the gyroscopic moments and the weight.
void add_loads(const Model& m, double t, const Angles& angles, const double* q, const double* v,
               double* f) {
  const double omega = eq::spin_speed(m, v);
  eq::add_linear_loads(m, omega, eq::working_at(m, t).data(), q, v, f);
  add_ring_supports(m, q, v, f);
  eq::add_forces(m, t, q, f);
  if (!m.unbalances.empty()) eq::add_unbalance(m, angles, omega, f);
  eq::add_drive(m, t, q, v, f);
}

}  // namespace

double spin_angle(const Model& m, double t, const double* q) { return eq::spin_angle(m, t, q); }
double spin_speed(const Model& m, const double* v) { return eq::spin_speed(m, v); }
double motor_torque(const Model& m, double t, const double* q, const double* v) {
  return m.drive ? eq::motor_torque(m, t, q, v) : 0.0;
}

Eigen::Vector2d bearing_current(const Model& m, const StationFeedback& bearing, double t,
                                const double* q, const double* v) {
  // Without a working feedback, only the coil of an amplifier has a current, which decays.
  if (!bearing.works.at(t))
    return vector(eq::feedback_state(m, bearing.states.current, v, eq::Pair{0.0, 0.0}));
  const int n = m.layout.modes;
  const eq::Pair deflection = eq::at_station(n, bearing.sensor_shape(), q);
  const eq::Pair rate = eq::at_station(n, bearing.sensor_shape(), v);
  return vector(eq::bearing_current(m, bearing, deflection, rate, v).current);
}

void coupling_force(const Model& m, double t, const double* q, const double* v, double* f) {
  load_force(m, t, q, v, f);
  eq::add_gyroscopic(m, spin_speed(m, v), v, f);
}

void load_force(const Model& m, double t, const double* q, const double* v, double* f) {
  const Layout& l = m.layout;
  if (m.weight.size() > 0) {
    std::copy_n(m.weight.data(), l.nq(), f);
  } else {
    std::fill_n(f, l.nq(), 0.0);
  }
  add_loads(m, t, angles_at(m, t, q), q, v, f);
}

void unactuated_force(const Model& m, double t, const double* q, const double* v, double* f) {
  unactuated_force(m, t, angles_at(m, t, q), q, v, f);
}

void unactuated_force(const Model& m, double t, const Angles& angles, const double* q,
                      const double* v, double* f) {
  eq::diagonal_force(m, q, v, f);
  add_loads(m, t, angles, q, v, f);
  eq::add_gyroscopic(m, spin_speed(m, v), v, f);
}

void solve_mass(const Model& m, double t, const double* q, const double* f, double* a) {
  solve_mass(m, m.mass.data(), t, q, f, a);
}

void solve_mass(const Model& m, const double* mass, double t, const double* q, const double* f,
                double* a) {
  if (m.coupled_mass()) return InverseMass(m, mass, t, q).solve(f, a);
  for (int i = 0; i < m.nq(); ++i) a[i] = f[i] / mass[i];
}

Eigen::Vector2d rotor_point(const Model& m, const double* q, std::size_t k) {
  return at_station(m.layout, m.auxiliary[k].shape, q);
}

Eigen::Vector2d stator_point(const Model& m, const double* q, std::size_t k) {
  const int ring = m.auxiliary[k].ring;
  if (ring == kAbsent) return {0.0, 0.0};
  return {q[ring], q[ring + 1]};
}

Eigen::Vector2d ring_centre(const Model& m, const double* q, std::size_t k) {
  return m.auxiliary[k].ring_offset + stator_point(m, q, k);
}

Eigen::Vector2d separation(const Model& m, const double* q, std::size_t k) {
  return vector(eq::separation(m, m.auxiliary[k], q));
}

ContactPoint contact_point(const Model& m, const double* q, const double* v, std::size_t k) {
  const AuxiliaryBearing& at = m.auxiliary[k];
  const double radius = at.contact ? at.contact->radius : 0.0;
  const double clearance = at.contact ? at.contact->clearance : 0.0;
  const eq::Pair d = eq::separation(m, at, q), rate = eq::relative(m, at, v);
  return contact_kinematics({d.x, d.y}, {rate.x, rate.y}, eq::contact_spin(m, at, v), radius,
                            clearance);
}

Eigen::Vector3d contact_rates(const Model& m, const double* v, std::size_t k) {
  const eq::Pair w = eq::relative(m, m.auxiliary[k], v);
  return {w.x, w.y, eq::contact_spin(m, m.auxiliary[k], v)};
}

Eigen::Vector3d contact_acceleration(const Model& m, const double* a, std::size_t k) {
  const Eigen::Vector2d d = rotor_point(m, a, k) - stator_point(m, a, k);
  double spin = m.layout.spin ? a[m.layout.phi()] : 0.0;  // a prescribed speed is constant
  if (eq::turns_at_contact(m)) spin += eq::turning_at_contact(m, m.auxiliary[k], a);
  return {d.x(), d.y(), spin};
}

Eigen::Matrix3d contact_admittance(const Model& m, double t, const double* q, std::size_t k) {
  if (!m.coupled_mass()) return m.auxiliary[k].admittance;
  return contact_admittance(m, m.mass.data(), t, q, k, k);
}

Eigen::Matrix3d contact_admittance(const Model& m, const double* mass, double t, const double* q,
                                   std::size_t i, std::size_t j) {
  return InverseMass(m, mass, t, q).admittance(i, j);
}

void add_contact_load(const Model& m, const Eigen::Vector3d& p, double* f, std::size_t k) {
  eq::add_contact_load(m, m.auxiliary[k], p.x(), p.y(), p.z(), f);
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
  for (const StationSupport& s : m.supports) {
    for (int k = 0; s.housing != kAbsent && k < 2; ++k) {
      e -= s.stiffness[k] * q[s.ring + k] * q[s.housing + k];
    }
  }
  if (m.coupled_mass()) {
    double b[kMaxCoordinates], bending = 0.0;
    eq::spin_coupling(m, angles_at(m, t, q), b, b + l.modes);
    for (int k = 0; k < 2 * l.modes; ++k) bending += b[k] * v[k];
    e += v[l.phi()] * bending;
  }
  return e;
}

double switching_work(const Model& m, double from, double to, const double* q, const double* v) {
  if (!m.coupled_mass()) return 0.0;
  const Layout& l = m.layout;
  double work = 0.0;
  for (const DiscUnbalance& u : m.unbalances) {
    if (u.on <= from || u.on > to) continue;
    const double angle = spin_angle(m, to, q) + u.phase;
    const Eigen::Vector2d rate = at_station(l, u.shape, v);
    work +=
        v[l.phi()] * u.static_moment * (std::cos(angle) * rate.y() - std::sin(angle) * rate.x());
  }
  return work;
}

double external_power(const Model& m, double t, const double* q, const double* v,
                      std::span<const Eigen::Vector2d> ring_forces) {
  const Layout& l = m.layout;
  double f[kMaxCoordinates];
  unactuated_force(m, t, q, v, f);
  for (std::size_t k = 0; k < ring_forces.size(); ++k) {
    const int ring = m.auxiliary[k].ring;
    if (ring == kAbsent) continue;
    f[ring] += ring_forces[k].x();
    f[ring + 1] += ring_forces[k].y();
  }
  double power = 0.0;
  for (int i = 0; i < l.mechanical(); ++i) power += (f[i] + m.stiffness[i] * q[i]) * v[i];
  return power + extra_power(m, angles_at(m, t, q), q, v);
}

double extra_power(const Model& m, const Angles& angles, const double* q, const double* v) {
  const Layout& l = m.layout;
  double power = 0.0;
  power -= coupling_power(m, q, v);
  for (const StationSpring& s : m.springs) {
    power += s.stiffness.cwiseProduct(at_station(l, s.shape, q)).dot(at_station(l, s.shape, v));
  }
  if (m.coupled_mass()) {
    // With a free spin m e Omega^2 is an inertial force: it moves energy between spin and bending.
    const double omega = spin_speed(m, v);
    for (std::size_t i = 0; i < m.unbalances.size(); ++i) {
      const DiscUnbalance& disc = m.unbalances[i];
      const Eigen::Vector2d rate = at_station(l, disc.shape, v);
      power -= disc.static_moment * omega * omega *
               (angles.cosine[i] * rate.x() + angles.sine[i] * rate.y());
    }
  }
  return power;
}

// ------------------------------------------------------------------ rings
// Forces on rings beyond springs and dampers to the base.
void add_ring_supports(const Model& m, const double* q, const double* v, double* f) {
  for (const StationSupport& s : m.supports) {
    const Eigen::Vector2d ring = pair_at(q, s.ring), housing = pair_at(q, s.housing);
    const Eigen::Vector2d rate = pair_at(v, s.ring), housing_rate = pair_at(v, s.housing);
    const Eigen::Vector2d r = ring - housing, w = rate - housing_rate;
    const Eigen::Vector2d bristle = pair_at(v, s.bristle);
    const Eigen::Vector2d law_force = s.law.force(r, w, bristle);
    // The diagonals contain -k r_ring for the ring and -k r_housing for the housing.
    for (int k = 0; k < 2; ++k) {
      f[s.ring + k] += law_force[k];
      if (s.housing == kAbsent) continue;
      f[s.ring + k] += s.stiffness[k] * housing[k] + s.damping[k] * housing_rate[k];
      f[s.housing + k] += s.stiffness[k] * ring[k] + s.damping[k] * rate[k] - law_force[k];
    }
    if (s.bristle != kAbsent) {
      const Eigen::Vector2d rising = bristle_rate(w, bristle, s.law.dry->presliding);
      for (int k = 0; k < 2; ++k) f[s.bristle + k] += m.mass[s.bristle + k] * rising[k];
    }
    if (s.spin_bristle == kAbsent) continue;
    const Eigen::Vector2d load =
        law_force - s.stiffness.cwiseProduct(r) - s.damping.cwiseProduct(w);
    const double state = v[s.spin_bristle];
    f[s.ring_angle] -= s.law.drag_torque(load.norm()) * state;
    f[s.spin_bristle] +=
        m.mass[s.spin_bristle] * bristle_rate(v[s.ring_angle], state, s.law.drag->presliding_angle);
  }
}

void step_bristles(const Model& m, const double* v, const double* from, double h, double* f) {
  for (const StationSupport& s : m.supports) {
    if (s.bristle != kAbsent) {
      const Eigen::Vector2d w = pair_at(v, s.ring) - pair_at(v, s.housing);
      const Eigen::Vector2d begin = pair_at(from, s.bristle);
      const Eigen::Vector2d end = bristle_after(w, w.norm(), begin, s.law.dry->presliding, h);
      for (int k = 0; k < 2; ++k) {
        f[s.bristle + k] = m.mass[s.bristle + k] * (end[k] - begin[k]) / h;
      }
    }
    if (s.spin_bristle == kAbsent) continue;
    const double w = v[s.ring_angle], begin = from[s.spin_bristle];
    const double end = bristle_after(w, std::abs(w), begin, s.law.drag->presliding_angle, h);
    f[s.spin_bristle] = m.mass[s.spin_bristle] * (end - begin) / h;
  }
}

double coupling_power(const Model& m, const double* q, const double* v) {
  double power = 0.0;
  for (const StationSupport& s : m.supports) {
    for (int k = 0; s.housing != kAbsent && k < 2; ++k) {
      power +=
          s.stiffness[k] * (q[s.housing + k] * v[s.ring + k] + q[s.ring + k] * v[s.housing + k]);
    }
  }
  return power;
}

}  // namespace rotorub
