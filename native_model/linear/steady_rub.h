// The lasting rubs of a rotor in its ring that stand still in a frame turning at nu: with the
// contact's direction as the real axis, (1 + i tau) lambda the force of the rotor on the ring,
// a(nu) the deflection at the contact that the load alone would give, and H(nu) of rub_system.h
//
//   a e^{-i psi_0} = delta_0 + lambda (1 + i tau) H(nu)
//
//   forced    nu of the load, tau = mu(|slip|) sign(slip): with h = (1 + i tau) H
//             |h|^2 lambda^2 + 2 delta_0 Re(h) lambda + delta_0^2 - |a|^2 = 0, both roots >= 0
//   whip      no load, nu against the spin, slipping: Im H + tau Re H = 0, Re H < 0,
//             lambda = -delta_0 Re H / |H|^2                                     (Black 1968)
//   rolling   no load, nu = -r Omega / delta_0, no slip: tau = -Im H / Re H, |tau| <= mu(0), Re H <
//   0
//
// Where the ring turns, friction and drag keep its speed, R tau lambda = drag Omega_f: sliding as
// above, lambda being the same at any slip of that sign, or, of each kind, rolling on the ring:
// R Omega_f = r Omega + delta_0 nu at any nu, |tau| <= mu, and with kappa = drag Omega_f / R
//
//   forced    |delta_0 + (lambda + i kappa) H| = |a|
//   rolling   kappa = delta_0 Im H / |H|^2, which nu solves
//
// Whip and rolling leave the load out: it makes them beat. Existence is not stability
// (rub_stability.h).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "native_model/linear/rub_system.h"

namespace rotorub::rub {

enum class RubKind { kForced, kWhip, kRolling };
const char* to_string(RubKind kind);  // "forced", "whip", "rolling"

struct SteadyRub {
  RubKind kind;
  double whirl;             // rad/s, nu, backward negative
  double normal_force;      // N, lambda >= 0
  double friction;          // tau, signed: of the force on the ring, along e_t
  double slip;              // m/s, r Omega + delta_0 nu - R Omega_f; 0 where it rolls
  double direction;         // rad, psi at t = 0; of whip and rolling 0, as any may be
  Eigen::VectorXcd rotor;   // m, n modes, in the turning frame with e_r as the real axis
  Complex ring;             // m, likewise
  double ring_speed = 0.0;  // rad/s, Omega_f
  bool rolls() const { return slip == 0.0; }
};

// By falling normal force; at most two, and two rolling on a ring that turns. None where the slip
// on a ring at rest is 0.
std::vector<SteadyRub> forced_rubs(const RubSystem& system, const RotatingLoad& load);

// |a|, m: the free orbit at the contact. Infinite at an undamped resonance.
double free_orbit(const RubSystem& system, const RotatingLoad& load);

// Whether a whirl can roll where the relative centre gives way by h = H(nu), m/N: Re H < 0 and
// |tau| <= mu.
bool can_roll(const Complex& h, double mu);

// rad/s, ascending, from `low` to `top`: evenly in the logarithm, and about each resonance (poles:
// s of e^{s t}) in steps that double from a quarter of its half width.
std::vector<double> resonance_points(const std::vector<Complex>& poles, double low, double top);

// H(nu) against the spin over all nu > 0 that matter, on points that stand close about each
// resonance, and at each extreme of the friction asked for, so that no two zeros between two of
// them are missed. Shared by all frictions.
class BackwardCompliance {
 public:
  // Points up to 20 times the highest frequency of rotor and ring, or the speed of rolling. Holds
  // the system without its loads. Throws RotorNotSolvable (rotor/refusal.h) as free_eigenvalues
  // does.
  explicit BackwardCompliance(const RubSystem& system);

  // nu > 0 of Im H + tau Re H = 0 with Re H < 0 (|tau| = mu, the sign of a spin faster than
  // rolling), ascending: where friction mu is just enough for rolling contact. Empty without spin.
  // A fold, where two roots are born, is one root.
  std::vector<double> edges(double mu) const;
  // The same with mu of the slip of each nu.
  std::vector<double> edges(const FrictionLaw& friction) const;
  // nu in [first, second] where a whirl against the spin can roll; the last may reach to infinity.
  std::vector<std::pair<double, double>> rolling_ranges(double mu) const;
  // Slipping whips, slower than rolling, by rising |nu|.
  std::vector<SteadyRub> whips(const FrictionLaw& friction) const;
  // On a ring that turns, at whirls at which its drag is what friction gives; by rising |nu|.
  std::vector<SteadyRub> rolling_on_ring(double mu) const;
  // Of a ring that does not: at the spin's own pace, if friction mu is enough.
  std::optional<SteadyRub> rolling(double mu) const;

 private:
  Complex at(double nu) const;    // H, conjugate where the spin is negative
  double asked(double nu) const;  // rad, atan tau where Re H < 0; beyond +-pi/2 no pressing contact
  SteadyRub standing(RubKind kind, double nu) const;
  double rolling_pace() const;  // rad/s, of nu
  std::vector<double> roots(const std::function<double(double)>& f, const std::vector<double>& nu,
                            const std::vector<double>& values) const;

  RubSystem system_;
  double sense_;  // +1: the spin is positive and backward is negative; 0: no spin
  std::vector<double> nu_;
  std::vector<double> asked_;
};

}  // namespace rotorub::rub
