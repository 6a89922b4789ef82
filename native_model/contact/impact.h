// Poisson's impact law with Coulomb friction and tangential restitution, (15)-(19), in closed form
// by cases. Compression: solve_coulomb on momenta. Expansion:
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

// Where the impulses of one contact may lie: L_N >= n, L_T in [low(L_N), high(L_N)]. n = 0 and no
// side is Coulomb's, of a compression; the expansion has another.
struct ContactSet {
  double friction = 0.0;      // mu >= 0
  double least_normal = 0.0;  // n, N s
  double side = 0.0;     // +1, -1: the friction begun in compression goes on to this side; 0: none
  double floor = 0.0;    // with a side: least friction to it, N s, >= 0
  double slides = 0.0;   // +1, -1: it slides so, whatever y_T is (an acceleration); 0: y_T decides
  bool pressed = false;  // L_N = n, whatever y_N is: a contact that gives

  double low(double normal) const {
    if (slides != 0.0) return -slides * friction * normal;
    return side > 0.0 ? floor : -friction * normal;
  }
  double high(double normal) const {
    if (slides != 0.0) return -slides * friction * normal;
    return side < 0.0 ? -floor : friction * normal;
  }
};
// Of the expansion that follows a compression of L_NC, L_TC, with this mu.
ContactSet expansion_set(const ImpactLaw& law, double mu, double normal, double friction);

struct ImpactResult {  // after compression and after expansion
  Status status = Status::kOk;
  double normal_compression = 0.0, friction_compression = 0.0;  // N s, L_NC, L_TC
  double normal_expansion = 0.0, friction_expansion = 0.0;      // N s, L_NE, L_TE
  double gap_rate_compression = 0.0, slip_compression = 0.0;    // m/s, gdot_NC, gdot_TC
  double gap_rate = 0.0, slip = 0.0;                            // m/s, gdot_NE, gdot_TE
  double normal() const { return normal_compression + normal_expansion; }
  double friction() const { return friction_compression + friction_expansion; }
};

// The classical, instantaneous law (tau_C = tau_E = 0): gap_rate and slip just before.
ImpactResult solve_impact(const Delassus& g, double gap_rate, double slip, const ImpactLaw& law);

// The law in contact space: from the relative velocity before to the impulses, with the compression
// and expansion times of (15)-(19).
struct ImpactInput {
  Eigen::Matrix3d admittance;    // J M^-1 J^T
  Eigen::Vector2d e_r;           // outward normal
  double radius = 0.0;           // m
  double delta = 0.0;            // m, distance of the centres
  Eigen::Vector3d velocity;      // (ddot, Omega_c) before the impact
  Eigen::Vector3d acceleration;  // of the same without contact; used over tau_C and tau_E only
  double compression_time = 0.0, expansion_time = 0.0;  // s
};

// With tau = 0 the classical law. Otherwise the rows of (16): gdot_N at the end of a phase is
// -e_r . ddot + What_N . (ddot tau), and
//   What_N . Delta d = -(e_t . ddot) (e_t . Delta d) / delta,
//   What_T . Delta d =  gdot_N (e_t . Delta d) / delta                                       (8)
ImpactResult solve_impact(const ImpactInput& input, const ImpactLaw& law);

// J, of an impulse between the rates (gdot_N, gdot_T) before and after it, which friction and
// Poisson's law keep from being a gain.
struct ImpulseWork {
  double normal, friction;
  double total() const { return normal + friction; }
};
inline ImpulseWork impulse_work(double normal, double friction, const Eigen::Vector2d& before,
                                const Eigen::Vector2d& after) {
  return {0.5 * normal * (before.x() + after.x()), 0.5 * friction * (before.y() + after.y())};
}

// What follows an impact: flight, or lasting contact. Decided once, for every engine.
//
// Loads and the circle's curvature press with a = -gddot_N, so that the flight after a rebound of
// the speed v lasts 2 v / a. A flight that is over too soon does not count: the impact has
// restitution 0, and contact lasts. An accumulation of impacts ends so. Too soon is
// - before the impact itself is, of one that takes time;
// - within a fixed step, of an impact that is located in its step;
// - within two, where it is not: the step's end then tells its speed with up to the fall of a whole
//   step, a h. Then bounces of v = eps_N v + a h keep themselves going for ever: an impact that
//   takes no more than that from its speed has no restitution either (but for long flights, and
//   without any loss there is no accumulation).

// m/s^2, a, of the relative velocity (ddot, contact spin) and the loads' acceleration of the same,
// along the outward normal e_r of a circle of radius delta (m): what turning of the normal adds is
// (e_t . ddot)^2 / delta.
inline double pressing(const Eigen::Vector2d& e_r, const Eigen::Vector3d& velocity,
                       const Eigen::Vector3d& acceleration, double delta) {
  const double whirl = e_r.x() * velocity.y() - e_r.y() * velocity.x();
  return e_r.dot(acceleration.head<2>()) + whirl * whirl / delta;
}

// Whether a flight that begins with `speed` (m/s, of the gap) under `pressed` (m/s^2, a) outlives
// `time` (s).
inline bool flight_outlives(double time, double speed, double pressed) {
  return 2.0 * speed > pressed * time;
}

// Of an impact that is not located in its step, h (s), with the speed `approach` (m/s).
inline bool rebound_outlives_steps(double h, double restitution, double approach, double pressed) {
  constexpr double kLeastSteps = 2.0, kMostSteps = 40.0;
  const double rebound = restitution * approach;
  if (!flight_outlives(kLeastSteps * h, rebound, pressed)) return false;
  const bool feeds_itself = restitution < 1.0 && (1.0 - restitution) * approach <= pressed * h;
  return !feeds_itself || flight_outlives(kMostSteps * h, rebound, pressed);
}

// eps_N of an impact that takes time, at the speed `approach` (m/s) beside loads that press with
// `load` (m/s^2). Poisson's law returns a share of what the loads compress too: v' = eps_N (v + a
// tau_C) - a tau_E, after the flight v'' = sqrt(v'^2 + 2 a tau_E v'), which above some eps_N has a
// fixed point: impacts without end. So where the loads give back more than half of what restitution
// takes, v'' > (1 + eps_N) v / 2, the approach's share alone is returned, eps_N v / (v + a tau_C):
// the impacts fall off with eps_N, and contact comes to rest.
double restitution_beside_loads(double restitution, double approach, double load,
                                double compression_time, double expansion_time);

}  // namespace rotorub
