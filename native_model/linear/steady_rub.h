// Lasting rubs of a rotor in its ring that are steady in a frame rotating at nu. The contact
// direction is the real axis, (1 + i tau) lambda is the force of the rotor on the ring, a(nu) the
// deflection at the contact that the load alone would cause, and H(nu) is defined in rub_system.h:
//
//   a e^{-i psi_0} = delta_0 + lambda (1 + i tau) H(nu)
//
//   forced    nu of the load, tau = mu(|slip|) sign(slip): with h = (1 + i tau) H
//             |h|^2 lambda^2 + 2 delta_0 Re(h) lambda + delta_0^2 - |a|^2 = 0, both roots >= 0
//   whip      no load, nu against the spin, slipping: Im H + tau Re H = 0, Re H < 0,
//             lambda = -delta_0 Re H / |H|^2                                     (Black 1968)
//   rolling   no load, nu = -r Omega / delta_0, no slip: tau = -Im H / Re H, |tau| <= mu(0),
//             Re H < 0
//
// If the ring turns, friction and drag determine its speed: R tau lambda = drag Omega_f. Sliding is
// as above, since lambda is the same at any slip of that sign. Both kinds can also roll on the
// ring, R Omega_f = r Omega + delta_0 nu, at any nu with |tau| <= mu; with kappa = drag Omega_f / R
//
//   forced    |delta_0 + (lambda + i kappa) H| = |a|
//   rolling   kappa = delta_0 Im H / |H|^2, solved for nu
//
// Whip and rolling leave out the load, which would make them beat. A rub that exists need not be
// stable (rub_stability.h).
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
  double whirl;             // rad/s, nu, negative if backward
  double normal_force;      // N, lambda >= 0
  double friction;          // tau, signed: friction ratio of the force on the ring, along e_t
  double slip;              // m/s, r Omega + delta_0 nu - R Omega_f; 0 if it rolls
  double direction;         // rad, psi at t = 0; 0 for whip and rolling, where it is arbitrary
  Eigen::VectorXcd rotor;   // m, n modes, in the rotating frame with e_r as the real axis
  Complex ring;             // m, in the same frame
  double ring_speed = 0.0;  // rad/s, Omega_f
  bool rolls() const { return slip == 0.0; }
};

// Forced rubs by falling normal force: at most two sliding, and two rolling on a ring that turns.
// Empty if the slip on a ring at rest is 0.
std::vector<SteadyRub> forced_rubs(const RubSystem& system, const RotatingLoad& load);

// |a|, m: radius of the free orbit at the contact. Infinite at an undamped resonance.
double free_orbit(const RubSystem& system, const RotatingLoad& load);

// Whether a whirl can roll at the relative compliance h = H(nu), m/N: Re H < 0 and |tau| <= mu.
bool can_roll(const Complex& h, double mu);

// Frequencies in rad/s, ascending, from `low` to `top`: evenly spaced in the logarithm, and around
// each resonance (poles: s of e^{s t}) in steps that double from a quarter of its half-width.
std::vector<double> resonance_points(const std::vector<Complex>& poles, double low, double top);

// H(nu) against the spin over all relevant nu > 0. The points are dense around each resonance and
// include every extreme of the friction required, so that no pair of zeros between two points is
// missed. Shared by all frictions.
class BackwardCompliance {
 public:
  // The points extend to 20 times the highest frequency of rotor and ring, or to the rolling speed
  // if that is higher. Keeps a copy of the system without its loads. Throws RotorNotSolvable as
  // free_eigenvalues does.
  explicit BackwardCompliance(const RubSystem& system);

  // The nu > 0, ascending, at which friction mu is just sufficient for rolling contact:
  // Im H + tau Re H = 0 with Re H < 0 (|tau| = mu, with the sign for a spin faster than rolling).
  // Empty without spin. A fold, where two roots merge, counts as one root.
  std::vector<double> edges(double mu) const;
  // The same with mu depending on the slip at each nu.
  std::vector<double> edges(const FrictionLaw& friction) const;
  // Ranges of nu [first, second] in which a whirl against the spin can roll; the last may extend to
  // infinity.
  std::vector<std::pair<double, double>> rolling_ranges(double mu) const;
  // Slipping whips, which are slower than rolling, by rising |nu|.
  std::vector<SteadyRub> whips(const FrictionLaw& friction) const;
  // Rolling on a ring that turns, at the whirls where its drag equals the friction torque; by
  // rising |nu|.
  std::vector<SteadyRub> rolling_on_ring(double mu) const;
  // Rolling on a ring that does not turn, at the whirl that the spin dictates; empty if friction mu
  // is too small.
  std::optional<SteadyRub> rolling(double mu) const;

 private:
  Complex at(double nu) const;  // H, conjugated if the spin is negative
  // rad, atan tau of the friction required; beyond +-pi/2 (Re H > 0) no contact force is possible.
  double asked(double nu) const;
  SteadyRub standing(RubKind kind, double nu) const;
  double rolling_pace() const;  // rad/s, |nu| of rolling
  std::vector<double> roots(const std::function<double(double)>& f, const std::vector<double>& nu,
                            const std::vector<double>& values) const;

  RubSystem system_;
  double sense_;  // +1: positive spin, backward is negative; -1: negative spin; 0: no spin
  std::vector<double> nu_;
  std::vector<double> asked_;
};

}  // namespace rotorub::rub
