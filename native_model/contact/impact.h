// Poisson's impact law with Coulomb friction and tangential restitution, (15)-(19), in closed form
// by cases. Compression is solve_coulomb() for impulses. Expansion:
//
//   normal:      L_NE >= eps_N L_NC,  gdot_NE >= 0,  gdot_NE (L_NE - eps_N L_NC) = 0
//   tangential (Beitelschmidt, gdot_TE0 = 0), s = sign(L_TC), u = s gdot_TE:
//     u < 0:  s L_TE = mu L_NE
//     u = 0:  s L_TE in [eps_N eps_T |L_TC|, mu L_NE]
//     u > 0:  s L_TE = eps_N eps_T |L_TC|
//   L_TC = 0: the symmetric Coulomb set |L_TE| <= mu L_NE.
#pragma once

#include <Eigen/Core>

#include "native_model/contact/contact_parameters.h"
#include "native_model/contact/impact_record.h"
#include "native_model/contact/kinematics.h"
#include "native_model/contact/planar_contact.h"
#include "native_model/numerics/status.h"

namespace rotorub {

// The set of admissible impulses of one contact: L_N >= n, L_T in [low(L_N), high(L_N)]. With n = 0
// and no side it is Coulomb's set, which a compression has; expansion_set() makes the set of an
// expansion.
struct ContactSet {
  double friction = 0.0;      // mu >= 0
  double least_normal = 0.0;  // n, N s
  double side = 0.0;          // +1, -1: side of the friction impulse of the compression; 0: none
  double floor = 0.0;         // with a side: least friction impulse to it, N s, >= 0
  // +1, -1: known direction of sliding (y_T is an acceleration); 0: y_T decides.
  double slides = 0.0;
  bool normal_known = false;  // L_N = n for any y_N: a compliant contact

  double low(double normal) const {
    if (slides != 0.0) return -slides * friction * normal;
    return side > 0.0 ? floor : -friction * normal;
  }
  double high(double normal) const {
    if (slides != 0.0) return -slides * friction * normal;
    return side < 0.0 ? -floor : friction * normal;
  }
};
// The set of the expansion after a compression with the impulses L_NC, L_TC.
ContactSet expansion_set(const ImpactLaw& law, double mu, double normal, double friction);

// Impulses and rates of one impact, after its compression and after its expansion.
struct ImpactResult {
  Status status = Status::kOk;
  double normal_compression = 0.0, friction_compression = 0.0;  // N s, L_NC, L_TC
  double normal_expansion = 0.0, friction_expansion = 0.0;      // N s, L_NE, L_TE
  double gap_rate_compression = 0.0, slip_compression = 0.0;    // m/s, gdot_NC, gdot_TC
  double gap_rate = 0.0, slip = 0.0;                            // m/s, gdot_NE, gdot_TE
  double normal() const { return normal_compression + normal_expansion; }
  double friction() const { return friction_compression + friction_expansion; }
};

// The classical, instantaneous law (tau_C = tau_E = 0). gap_rate, slip: just before the impact.
ImpactResult solve_impact(const Delassus& g, double gap_rate, double slip, const ImpactLaw& law);

// The law in contact space, with the compression and expansion times of (15)-(19).
struct ImpactInput {
  Eigen::Matrix3d admittance;    // J M^-1 J^T
  Eigen::Vector2d e_r;           // outward normal
  double radius = 0.0;           // m
  double delta = 0.0;            // m, distance of the centres
  Eigen::Vector3d velocity;      // (ddot, Omega_c) before the impact
  Eigen::Vector3d acceleration;  // of `velocity` without contact; used only with tau_C, tau_E
  double compression_time = 0.0, expansion_time = 0.0;  // s
};

// Without impact times this is the classical law. Otherwise it uses the rows of (16): gdot_N at the
// end of a phase is -e_r . ddot + What_N . (ddot tau), with
//   What_N . Delta d = -(e_t . ddot) (e_t . Delta d) / delta,
//   What_T . Delta d =  gdot_N (e_t . Delta d) / delta                                       (8)
ImpactResult solve_impact(const ImpactInput& input, const ImpactLaw& law);

// J, work of an impulse, from the rates (gdot_N, gdot_T) before and after it. Friction and
// Poisson's law keep the total from being positive.
struct ImpulseWork {
  double normal, friction;
  double total() const { return normal + friction; }
};
inline ImpulseWork impulse_work(double normal, double friction, const Eigen::Vector2d& before,
                                const Eigen::Vector2d& after) {
  return {0.5 * normal * (before.x() + after.x()), 0.5 * friction * (before.y() + after.y())};
}

// The decision between flight and lasting contact after an impact, the same for every engine.
//
// Loads and the circle's curvature close the gap with the acceleration a = -gddot_N, so the flight
// after a rebound at speed v lasts 2 v / a. A flight that ends too soon does not count: the impact
// then has restitution 0, and contact lasts. Accumulations of impacts end in this way. A flight
// ends too soon
// - for an impact that takes time: if it ends before the impact itself does;
// - for an impact that is located within a fixed step: if it ends within one step;
// - for an impact that is not located: if it ends within two steps. The speed at the end of the
//   step then contains up to the fall of a whole step, a h, and bounces with v = eps_N v + a h
//   would sustain themselves for ever. Such an impact therefore also has no restitution if it loses
//   at most the speed a h, except if its flight is long (kMostSteps) or if eps_N = 1, because there
//   is no accumulation without loss.

// m/s^2, the closing acceleration a, from the relative velocity (ddot, contact spin) and its
// acceleration by the loads, for the outward normal e_r of a circle of radius delta (m). The
// turning of the normal contributes (e_t . ddot)^2 / delta.
inline double closing_acceleration(const Eigen::Vector2d& e_r, const Eigen::Vector3d& velocity,
                                   const Eigen::Vector3d& acceleration, double delta) {
  const double whirl = e_r.x() * velocity.y() - e_r.y() * velocity.x();
  return e_r.dot(acceleration.head<2>()) + whirl * whirl / delta;
}

// True if a flight that begins with the gap rate `speed` (m/s) under the closing acceleration a
// (m/s^2) lasts longer than `time` (s).
inline bool flight_outlives(double time, double speed, double a) { return 2.0 * speed > a * time; }

// The same decision for an impact that is not located within its step h (s). approach: m/s.
inline bool rebound_outlives_steps(double h, double restitution, double approach, double a) {
  constexpr double kLeastSteps = 2.0, kMostSteps = 40.0;
  const double rebound = restitution * approach;
  if (!flight_outlives(kLeastSteps * h, rebound, a)) return false;
  const bool feeds_itself = restitution < 1.0 && (1.0 - restitution) * approach <= a * h;
  return !feeds_itself || flight_outlives(kMostSteps * h, rebound, a);
}

// eps_N of an impact that takes time, with the approach speed `approach` (m/s) and the closing
// acceleration a of the loads (m/s^2). Poisson's law also returns a share of the compression by the
// loads: the rebound is v' = eps_N (v + a tau_C) - a tau_E, and the next approach v'' = sqrt(v'^2 +
// 2 a tau_E v'). Above some eps_N this has a fixed point, and the impacts never end. Therefore, if
// the loads restore more than half of the speed that restitution takes, v'' > (1 + eps_N) v / 2,
// only the share of the approach is returned: eps_N v / (v + a tau_C). The impacts then decay with
// eps_N, and contact comes to rest.
double restitution_under_loads(double restitution, double approach, double a,
                               double compression_time, double expansion_time);

}  // namespace rotorub
